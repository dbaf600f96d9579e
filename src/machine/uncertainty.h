#pragma once
// Uncertainty of the values of a machine file.

#include <string>
#include <vector>

namespace clsurf {

/// Uncertainty of one value: its standard error, a lower bound, or values that the runs could not distinguish.
struct ParameterUncertainty {
    std::string key;                     ///< as in the machine file: "max_acceleration", "lookahead_blocks" …
    std::string of;                      ///< "x" …, "path", "controller"
    double relative_error = 0;           ///< standard error over value
    double lower_bound = 0;              ///< in the unit of the machine file; 0: none
    std::vector<double> alternatives{};  ///< in the unit of the machine file; the value of the file among them
};

}  // namespace clsurf
