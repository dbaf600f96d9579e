#pragma once
// How well the values of a machine file are known.

#include <string>
#include <vector>

namespace clsurf {

/// How well one value is known: by its standard error, by what it is at least, or by values that the runs did not tell apart.
struct ParameterUncertainty {
    std::string key;                     ///< as in the machine file: "max_acceleration", "lookahead_blocks" …
    std::string of;                      ///< "x" …, "path", "controller"
    double relative_error = 0;           ///< standard error over value
    double lower_bound = 0;              ///< in the unit of the machine file; 0: none
    std::vector<double> alternatives{};  ///< in the unit of the machine file; the value of the file among them
};

}  // namespace clsurf
