#pragma once
// The range of a map, by rule: outliers and non-cutting points must not flatten the colours.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "field/field.h"
#include "surface/passes.h"

namespace clsurf {

struct RangeRule {
    enum class Kind : std::uint8_t { automatic, fixed, percentiles };
    Kind kind = Kind::automatic;
    double low = 0, high = 0;  ///< fixed: in shown units; percentiles: 0 … 100
};

struct ShownRange {
    double low = 0, high = 0;        ///< in shown units
    double lowest = 0, highest = 0;  ///< of all cutting points that are shown
    std::string note;                ///< what the rule did, for the picture's footnote
};

/// Which points the picture shows; empty: all.
using ShownPoints = std::function<bool(PointIndex)>;

/// `automatic`: 1st to 99th percentile of the cutting points that are shown; about 0 for diverging
/// fields. Over some 10^6 evenly spaced points. Throws InputError where no point has a value,
/// UsageError where none is shown. O(points).
[[nodiscard]] ShownRange find_range(const Field& field, const Passes& passes, const RangeRule& rule,
                                    const ShownPoints& shown = {});

/// What shows both on one scale.
[[nodiscard]] ShownRange wider(const ShownRange& a, const ShownRange& b);

/// Percentiles (0 … 100) of |value| in shown units, over some 10^6 evenly spaced cutting points; the 100th is the
/// largest of all. NaN where no cutting point has a value. O(points).
[[nodiscard]] std::vector<double> percentiles_of_size(const Field& field, const Passes& passes,
                                                      std::span<const double> percentiles);

}  // namespace clsurf
