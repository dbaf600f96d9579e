#include "field/range.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"

namespace clsurf {
namespace {

constexpr PointIndex sampled_points = 1'000'000;
constexpr double automatic_low = 1;
constexpr double automatic_high = 99;

double percentile(Column<float>& values, double p) {
    const double at = p / 100 * static_cast<double>(values.size() - 1);
    float* place = values.begin() + static_cast<std::ptrdiff_t>(std::lround(at));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

}  // namespace

ShownRange find_range(const Field& field, const Passes& passes, const RangeRule& rule) {
    if (rule.kind == RangeRule::Kind::fixed) return {rule.low, rule.high, "range as given"};
    PointIndex cutting = 0;
    for (const Pass& pass : passes) cutting += pass.kind == PassKind::cut ? pass.size() : 0;
    const PointIndex step = std::max<PointIndex>(1, cutting / sampled_points);
    Column<float> values;
    PointIndex next = 0;
    for (const Pass& pass : passes) {
        if (pass.kind != PassKind::cut) continue;
        PointIndex i = pass.first + next;
        for (; i <= pass.last; i += step) {
            const float value = field.values[static_cast<std::size_t>(i)];
            if (std::isfinite(value)) values.push_back(value);
        }
        next = i - pass.last - 1;
    }
    if (values.empty()) throw InputError({}, "field '" + field.info.name + "' has no value on any cutting point", "too few points, or the program and the log do not belong together?");
    const bool automatic = rule.kind == RangeRule::Kind::automatic;
    const double p_low = automatic ? automatic_low : rule.low;
    const double p_high = automatic ? automatic_high : rule.high;
    const double unit = field.info.unit.per_inside;
    ShownRange range{percentile(values, p_low) * unit, percentile(values, p_high) * unit, {}};
    if (automatic && field.info.scale == FieldScale::diverging) {
        const double most = std::max(std::abs(range.low), std::abs(range.high));
        range.low = -most;
        range.high = most;
    }
    range.note = fmt::format("range: percentiles {:g} to {:g} of {} cutting points{}", p_low, p_high, cutting,
                             automatic && field.info.scale == FieldScale::diverging ? ", even about 0" : "");
    return range;
}

}  // namespace clsurf
