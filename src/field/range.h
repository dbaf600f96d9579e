#pragma once
// The range that a map shows, by rule: outliers and what does not cut must not flatten the colours.

#include <string>

#include "field/field.h"
#include "path/passes.h"

namespace clsurf {

struct RangeRule {
    enum class Kind : std::uint8_t { automatic, fixed, percentiles };
    Kind kind = Kind::automatic;
    double low = 0, high = 0;  ///< fixed: in shown units; percentiles: 0 … 100
};

struct ShownRange {
    double low = 0, high = 0;  ///< in shown units
    std::string note;          ///< what the rule did, for the picture's footnote
};

/// `automatic`: 1st to 99th percentile of the cutting points; about 0 for diverging fields. Over at
/// most 10^6 evenly spaced points. Throws InputError where no point has a value.
[[nodiscard]] ShownRange find_range(const Field& field, const Passes& passes, const RangeRule& rule);

}  // namespace clsurf
