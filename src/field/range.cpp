#include "field/range.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.h"
#include "core/statistics.h"

namespace clsurf {
namespace {

constexpr PointIndex sampled_points = 1'000'000;
constexpr double automatic_low = 1;
constexpr double automatic_high = 99;

/// The values that the range is found from.
struct Values {
    Column<float> sampled;   ///< evenly spaced, finite
    PointIndex cutting = 0;  ///< points
    float lowest = std::numeric_limits<float>::infinity();
    float highest = -std::numeric_limits<float>::infinity();

    /// A point without a value fails both comparisons.
    void widen(float value) {
        if (value < lowest && value >= std::numeric_limits<float>::lowest()) lowest = value;
        if (value > highest && value <= std::numeric_limits<float>::max()) highest = value;
    }
};

Values values_of_all(const Field& field, const Passes& passes) {
    Values values;
    for (const Pass& pass : passes) values.cutting += pass.kind == PassKind::cut ? pass.size() : 0;
    const PointIndex step = std::max<PointIndex>(1, values.cutting / sampled_points);
    PointIndex next = 0;
    for (const Pass& pass : passes) {
        if (pass.kind != PassKind::cut) continue;
        for (PointIndex i = pass.first; i <= pass.last; ++i) values.widen(field.values[static_cast<std::size_t>(i)]);
        PointIndex i = pass.first + next;
        for (; i <= pass.last; i += step) {
            const float value = field.values[static_cast<std::size_t>(i)];
            if (std::isfinite(value)) values.sampled.push_back(value);
        }
        next = i - pass.last - 1;
    }
    return values;
}

Values values_of_shown(const Field& field, const Passes& passes, const ShownPoints& shown) {
    Values values;
    Column<float> all;
    for (const Pass& pass : passes) {
        if (pass.kind != PassKind::cut) continue;
        for (PointIndex i = pass.first; i <= pass.last; ++i) {
            if (!shown(i)) continue;
            ++values.cutting;
            const float value = field.values[static_cast<std::size_t>(i)];
            values.widen(value);
            if (std::isfinite(value)) all.push_back(value);
        }
    }
    const std::size_t step = std::max<std::size_t>(1, all.size() / static_cast<std::size_t>(sampled_points));
    for (std::size_t i = 0; i < all.size(); i += step) values.sampled.push_back(all[i]);
    return values;
}

}  // namespace

ShownRange find_range(const Field& field, const Passes& passes, const RangeRule& rule, const ShownPoints& shown) {
    Values values = shown ? values_of_shown(field, passes, shown) : values_of_all(field, passes);
    const bool fixed = rule.kind == RangeRule::Kind::fixed;
    const double unit = field.info.unit.per_inside;
    ShownRange range{rule.low, rule.high, values.lowest * unit, values.highest * unit, "range as given"};
    if (fixed) return range;
    if (shown && values.cutting == 0)
        throw UsageError("no cutting point lies in the part that is shown",
                         "another --box or --zoom, or a fixed --range MIN,MAX");
    if (values.sampled.empty())
        throw InputError({}, "field '" + field.info.name + "' has no value on any cutting point",
                         "too few points, or the program and the log do not belong together?");
    const bool automatic = rule.kind == RangeRule::Kind::automatic;
    const double p_low = automatic ? automatic_low : rule.low;
    const double p_high = automatic ? automatic_high : rule.high;
    range.low = nearest_quantile(values.sampled, p_low / 100) * unit;
    range.high = nearest_quantile(values.sampled, p_high / 100) * unit;
    const bool even = automatic && field.info.scale == FieldScale::diverging;
    if (even) {
        const double most = std::max(std::abs(range.low), std::abs(range.high));
        range.low = -most;
        range.high = most;
    }
    range.note = fmt::format("range: percentiles {:g} to {:g} of {} {}cutting points{}", p_low, p_high, values.cutting,
                             shown ? "shown " : "", even ? ", even about 0" : "");
    return range;
}

ShownRange wider(const ShownRange& a, const ShownRange& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high), std::min(a.lowest, b.lowest),
            std::max(a.highest, b.highest), a.note + ", the wider of both logs"};
}

std::vector<double> percentiles_of_size(const Field& field, const Passes& passes, std::span<const double> percentiles) {
    Values values = values_of_all(field, passes);
    for (float& value : values.sampled) value = std::abs(value);
    const double largest = std::max(std::abs(values.lowest), std::abs(values.highest));
    std::vector<double> found;
    for (const double p : percentiles) {
        const double value = values.sampled.empty() ? std::numeric_limits<double>::quiet_NaN()
                             : p >= 100             ? largest
                                                    : nearest_quantile(values.sampled, p / 100);
        found.push_back(value * field.info.unit.per_inside);
    }
    return found;
}

}  // namespace clsurf
