#pragma once
// Identification: what recorded runs tell of a machine, value by value.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.h"
#include "machine/machine.h"

namespace clsurf {

/// A value that the runs determine.
struct IdentifiedParameter {
    std::string name;                      ///< the key of the machine file; "lag" and "offset" have none
    std::string axis;                      ///< "x" …, "path", "controller"
    double value = 0;                      ///< in `unit`
    std::string unit;                      ///< empty: a ratio
    std::optional<double> standard_error;  ///< in `unit`
    std::optional<bool> reached;           ///< of limits; false: a lower bound, the runs never reached the limit
    std::string note;                      ///< evidence, a few words; may be empty
};

/// A value that they do not determine.
struct UnidentifiedParameter {
    std::string name, axis;
    std::string reason;
};

struct Identification {
    Machine machine;  ///< what was known before, with the identified values in it
    std::vector<IdentifiedParameter> parameters;
    std::vector<UnidentifiedParameter> unidentified;
    std::vector<std::string> runs;  ///< the logs, as the user named them
    Diagnostics diagnostics;

    [[nodiscard]] const IdentifiedParameter* find(std::string_view name, std::string_view axis) const;
    [[nodiscard]] const UnidentifiedParameter* find_missing(std::string_view name, std::string_view axis) const;
};

/// A value with the digits that its standard error leaves it, two of which are uncertain.
[[nodiscard]] double rounded_to(double value, double standard_error);

}  // namespace clsurf
