#include "field/range.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.h"
#include "core/listed.h"
#include "core/statistics.h"

namespace clsurf {
namespace {

constexpr PointIndex sampled_points = 1'000'000;
constexpr double automatic_low = 1;
constexpr double automatic_high = 99;

/// The values from which the range is determined.
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
    values.cutting = cutting_points(passes);
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

/// Widens a range to the least span of its field: about 0 or the middle, or from the end of the good values.
void widen_to_least_span(ShownRange& range, const FieldInfo& info, double median) {
    const double least =
        std::max(info.least_span * std::abs(info.unit.per_inside), info.least_span_of_median * std::abs(median));
    const double more = least - (range.high - range.low);
    if (!(more > 0)) return;
    switch (info.preference) {
        case FieldPreference::higher: range.low -= more; break;
        case FieldPreference::lower: range.high += more; break;
        case FieldPreference::none:
            range.low -= 0.5 * more;
            range.high += 0.5 * more;
            break;
    }
    range.note += "; no narrower, since smaller differences do not matter";
}

/// Ends at round numbers, so that a legend has few digits; for bins all edges.
void round_outwards(ShownRange& range, int bins, bool even) {
    const double span = range.high - range.low;
    if (!(span > 0) || !std::isfinite(span)) return;
    constexpr double fineness = 100;
    double step = round_up(span / (bins > 0 ? bins : fineness));
    if (bins > 0 && even) {
        range.high = 0.5 * bins * step;
        range.low = -range.high;
        return;
    }
    const auto low = [&] { return std::floor(range.low / step + 1e-9) * step; };
    while (bins > 0 && low() + bins * step < range.high * (1 - 1e-12)) step = round_up(step * 1.01);
    const double lowest = low();
    range.high = bins > 0 ? lowest + bins * step : std::ceil(range.high / step - 1e-9) * step;
    range.low = lowest;
    if (bins > 0) return;
    // "1025" is 1030: three digits, unless the range is too narrow for that.
    for (const bool upper : {false, true}) {
        double& end = upper ? range.high : range.low;
        if (end == 0) continue;
        const double digit = std::pow(10.0, std::floor(std::log10(std::abs(end)) + 1e-9) - 2);
        if (digit > 3 * step) continue;
        end = (upper ? std::ceil(end / digit - 1e-9) : std::floor(end / digit + 1e-9)) * digit;
    }
}

/// The data from which a range is determined.
struct Source {
    const Field& field;
    const Passes& passes;
    const Adjacency* neighbours;  ///< nullptr: unknown
    const ShownPoints& shown;
    std::span<const PointRange> defects;
};

/// The end extended to all values of the defects, in internal units.
float end_with_defects(const Source& source, float end, bool above) {
    for (const PointRange& section : source.defects) {
        for (PointIndex i = section.first; i <= section.last; ++i) {
            const float value = source.field.values[static_cast<std::size_t>(i)];
            if (!(above ? value > end : value < end) || !std::isfinite(value)) continue;
            // Points outside a selection no longer count as cut.
            if (source.passes[pass_of(source.passes, i)].kind != PassKind::cut) continue;
            if (!source.shown || source.shown(i)) end = value;
        }
    }
    return end;
}

/// An end of the range, extended so that it excludes nothing that must be shown.
float widened(const Source& source, float end, bool above) {
    end = end_without_patches(source.field, source.passes, source.neighbours, source.shown, end, above, least_patch);
    const auto threshold = static_cast<float>(source.field.info.threshold);
    if (threshold > 0)
        end = end_with_sections(source.field, source.passes, source.neighbours, source.shown, end, above, threshold,
                                least_section);
    return end_with_defects(source, end, above);
}

/// ", widened for patches of 20 points, 3 points together beyond the threshold and all defects"
std::string words_of_widening(const Source& source) {
    std::vector<std::string> reasons{fmt::format("patches of {} points", least_patch)};
    if (source.field.info.threshold > 0)
        reasons.push_back(fmt::format("{} points together beyond the threshold", least_section));
    if (!source.defects.empty()) reasons.emplace_back("all defects");
    return ", widened for " + listed(reasons);
}

/// The part common to all rules except the fixed ones.
ShownRange range_of_values(const Source& source, const RangeRule& rule, Values& values) {
    const Field& field = source.field;
    const double unit = field.info.unit.per_inside;
    ShownRange range{0, 0, values.lowest * unit, values.highest * unit, ""};
    const bool automatic = rule.kind == RangeRule::Kind::automatic;
    const double p_low = automatic ? automatic_low : rule.low;
    const double p_high = automatic ? automatic_high : rule.high;
    float low = nearest_quantile(values.sampled, p_low / 100);
    float high = nearest_quantile(values.sampled, p_high / 100);
    range.note = fmt::format("range: percentiles {:g} to {:g} of {} {}cutting points", p_low, p_high, values.cutting,
                             source.shown ? "shown " : "");
    if (automatic) {
        const float low_end = widened(source, low, false);
        const float high_end = widened(source, high, true);
        if (low_end < low || high_end > high) range.note += words_of_widening(source);
        low = low_end;
        high = high_end;
    }
    range.low = low * unit;
    range.high = high * unit;
    if (!automatic) return range;
    if (field.info.scale == FieldScale::diverging) {
        const double most = std::max(std::abs(range.low), std::abs(range.high));
        range.low = -most;
        range.high = most;
        range.note += ", symmetric about 0";
    }
    widen_to_least_span(range, field.info, nearest_quantile(values.sampled, 0.5) * unit);
    round_outwards(range, rule.bins, field.info.scale == FieldScale::diverging);
    return range;
}

ShownRange find_range_among(const Source& source, const RangeRule& rule) {
    const Field& field = source.field;
    const Passes& passes = source.passes;
    const ShownPoints& shown = source.shown;
    Values values = shown ? values_of_shown(field, passes, shown) : values_of_all(field, passes);
    const double unit = field.info.unit.per_inside;
    if (rule.kind == RangeRule::Kind::fixed)
        return {rule.low, rule.high, values.lowest * unit, values.highest * unit, "range as given"};
    if (shown && values.cutting == 0)
        throw UsageError("no cutting point lies in the part that is shown",
                         "choose another --box or --zoom, or a fixed --range MIN,MAX");
    if (values.sampled.empty())
        throw InputError({}, "field '" + field.info.name + "' has no value on any cutting point",
                         "too few points, or the program and the log do not belong together?");
    if (rule.kind == RangeRule::Kind::automatic && field.info.usual_range)
        return {field.info.usual_range->low * unit, field.info.usual_range->high * unit, values.lowest * unit,
                values.highest * unit, "the same range in all pictures"};
    return range_of_values(source, rule, values);
}

}  // namespace

ShownRange find_range(const Field& field, const ClSurface& surface, const RangeRule& rule, const ShownPoints& shown,
                      std::span<const PointRange> defects) {
    return find_range_among({field, surface.passes, &surface.neighbours, shown, defects}, rule);
}

ShownRange find_range(const Field& field, const Passes& passes, const RangeRule& rule, const ShownPoints& shown) {
    return find_range_among({field, passes, nullptr, shown, {}}, rule);
}

double round_up(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double factor : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
        if (factor * power >= value * (1 - 1e-9)) return factor * power;
    }
    return 10 * power;
}

ShownRange wider(const ShownRange& a, const ShownRange& b) {
    const bool equal = a.low == b.low && a.high == b.high;
    return {std::min(a.low, b.low), std::max(a.high, b.high), std::min(a.lowest, b.lowest),
            std::max(a.highest, b.highest), a.note + (equal ? "" : ", the wider of both logs")};
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
