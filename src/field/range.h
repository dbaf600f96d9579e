#pragma once
// The range of a map, by rule: outliers and non-cutting points must not flatten the colours.

#include <span>
#include <string>
#include <vector>

#include "field/field.h"
#include "field/patches.h"
#include "surface/cl_surface.h"

namespace clsurf {

struct RangeRule {
    enum class Kind : std::uint8_t { automatic, fixed, percentiles };
    Kind kind = Kind::automatic;
    double low = 0, high = 0;  ///< fixed: in shown units; percentiles: 0 … 100
    int bins = 0;              ///< automatic: steps whose edges must be round numbers; 0: the ends alone
};

struct ShownRange {
    double low = 0, high = 0;        ///< in shown units
    double lowest = 0, highest = 0;  ///< of all cutting points that are shown
    std::string note;                ///< the effect of the rule, for the picture's footnote
};

/// Points of a patch that no automatic range excludes.
inline constexpr std::size_t least_patch = 20;

/// Points of a section beyond the threshold of a field that no automatic range excludes.
inline constexpr std::size_t least_section = 3;

/// `automatic`: the field's usual range if it has one. Else the 1st to the 99th percentile of the cutting points that are
/// shown. It is widened so that no connected patch of 20 points is outside, no 3 connected points beyond the threshold of the
/// field, and none of `defects`; to the least span of the field, and to round numbers; symmetric about 0 for diverging
/// fields. Percentiles are from some 10^6 evenly spaced points. Throws InputError if no point has a value, UsageError if none
/// is shown. `defects`: sections of passes with defects, if known. O(points).
[[nodiscard]] ShownRange find_range(const Field& field, const ClSurface& surface, const RangeRule& rule,
                                    const ShownPoints& shown = {}, std::span<const PointRange> defects = {});
/// The same if adjacent passes are unknown: patches are sections of a pass.
[[nodiscard]] ShownRange find_range(const Field& field, const Passes& passes, const RangeRule& rule,
                                    const ShownPoints& shown = {});

/// The least of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is not less. Domain: value > 0.
[[nodiscard]] double round_up(double value);

/// A range that shows both on one scale.
[[nodiscard]] ShownRange wider(const ShownRange& a, const ShownRange& b);

/// Percentiles (0 … 100) of |value| in shown units, over some 10^6 evenly spaced cutting points; the 100th is the
/// largest of all. NaN if no cutting point has a value. O(points).
[[nodiscard]] std::vector<double> percentiles_of_size(const Field& field, const Passes& passes,
                                                      std::span<const double> percentiles);

}  // namespace clsurf
