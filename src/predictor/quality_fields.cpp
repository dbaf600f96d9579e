#include "predictor/quality_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/block.h"
#include "core/not_finite.h"

namespace clsurf {
namespace {

// Difference of a pass to the median of up to five passes on each side. Of two adjacent passes that differ, it shows the one
// that causes the difference.

float speed_mismatch(const Comparer& comparer, const Signals&, PointIndex i) {
    const Comparison comparison = comparer.compare({i, 0});
    return comparison.left + comparison.right > 0 ? comparison.speed_jump : missing<float>;
}

float acceleration_mismatch(const Comparer& comparer, const Signals&, PointIndex i) {
    return comparer.compare({i, 0}).residual[index_of(Quantity::acceleration)];
}

/// Difference to the adjacent pass that differs most. If two passes differ, both have it.
float speed_difference(const ClSurface& surface, const Signals& signals, PointIndex i) {
    float most = missing<float>;
    for (const Side side : {Side::left, Side::right}) {
        const PathLocation at = adjacent_location(surface, {i, 0}, signals.feed(i), side);
        if (!at.exists()) continue;
        const float d = signals[i].speed - compared_at(signals, at, signals.normal(i)).speed;
        if (!(std::abs(most) >= std::abs(d))) most = d == d ? d : most;
    }
    return most;
}

float speed_difference_of(const Comparer& comparer, const Signals& signals, PointIndex i) {
    return speed_difference(comparer.surface(), signals, i);
}

float height(const Comparer&, const Signals& signals, PointIndex i) {
    return signals.measured ? signals[i].normal_deviation : signals[i].relief;
}

float speed_threshold(const Thresholds& thresholds, bool) {
    return thresholds.of[index_of(Quantity::speed)] * thresholds.usual_speed;
}

float acceleration_threshold(const Thresholds& thresholds, bool) {
    return thresholds.of[index_of(Quantity::acceleration)];
}

float height_threshold(const Thresholds& thresholds, bool measured) {
    return thresholds.of[index_of(measured ? Quantity::normal_deviation : Quantity::relief)];
}

constexpr auto quality_rows = std::to_array<QualityFieldRow>({
    {"speed_mismatch",
     "Speed difference to the adjacent passes",
     {},
     unit::mm_min,
     FieldScale::diverging,
     &Signals::speed_note,
     speed_mismatch,
     {"mismatch"},
     7,
     true,
     speed_threshold},
    {"acceleration_mismatch",
     "Acceleration difference to the adjacent passes",
     {},
     unit::mm_s2,
     FieldScale::sequential,
     &Signals::acceleration_note,
     acceleration_mismatch,
     {},
     8,
     true,
     acceleration_threshold,
     FieldPreference::lower},
    {"height",
     "Height over the commanded surface",
     "Height over the chord between the adjacent passes",
     unit::um,
     FieldScale::diverging,
     &Signals::height_note,
     height,
     {},
     9,
     true,
     height_threshold},
    {"speed_difference",
     "Speed difference to the adjacent pass that differs most",
     {},
     unit::mm_min,
     FieldScale::diverging,
     &Signals::speed_note,
     speed_difference_of,
     {},
     0,
     true,
     speed_threshold},
});

FieldInfo info_of(const QualityFieldRow& row) {
    FieldInfo info{std::string(row.name), std::string(row.label), row.unit, row.scale, {}};
    if (!row.also.empty()) info.also.emplace_back(row.also);
    info.report_rank = row.report_rank;
    info.percentiles = row.percentiles;
    info.preference = row.preference;
    return info;
}

Field compute_row(const QualityFieldRow& row, const ClSurface& surface, const Signals& signals,
                  const Thresholds& thresholds, PointRange points) {
    const Comparer comparer(surface, signals, thresholds.least_speed);
    Field field;
    field.info = info_of(row);
    if (!signals.measured && !row.label_unmeasured.empty()) field.info.label = row.label_unmeasured;
    // Two thresholds for values that are signed about 0.
    const double sides = row.scale == FieldScale::diverging ? 2 : 1;
    if (row.threshold != nullptr) field.info.threshold = row.threshold(thresholds, signals.measured);
    field.info.least_span = 2 * sides * field.info.threshold;
    field.values.resize(static_cast<std::size_t>(points.size()));
    std::vector<PointIndex> with(static_cast<std::size_t>((points.size() + block_points - 1) / block_points));
    for_each_block(points.size(), [&](PointIndex first, PointIndex last) {
        for (PointIndex i = first; i < last; ++i) {
            const PointIndex point = points.first + i;
            const bool compared = signals[point].zone != Zone::outside;
            const float value = compared ? row.value(comparer, signals, point) : missing<float>;
            field.values[static_cast<std::size_t>(i)] = value;
            if (value == value) ++with[static_cast<std::size_t>(first / block_points)];
        }
    });
    PointIndex known = 0;
    for (const PointIndex n : with) known += n;
    const PointIndex cutting = cutting_points(surface.passes);
    field.info.note = signals.*row.windows;
    if (points.size() == surface.positions.size())
        field.info.note +=
            fmt::format("; {:.1f} % of the cutting points have a value",
                        cutting > 0 ? 100.0 * static_cast<double>(known) / static_cast<double>(cutting) : 0.0);
    return field;
}

}  // namespace

std::span<const QualityFieldRow> quality_field_table() { return quality_rows; }

QualityFields::QualityFields(const ClSurface& surface, std::function<Signals()> derive,
                             std::span<const QualityFieldRow> table)
    : surface_(surface), derive_(std::move(derive)), table_(table) {}

std::vector<FieldInfo> QualityFields::fields() const {
    std::vector<FieldInfo> infos;
    for (const QualityFieldRow& row : table_) infos.push_back(info_of(row));
    return infos;
}

std::vector<Field> QualityFields::compute(std::span<const std::string_view> names, PointRange points) const {
    std::call_once(derived_, [&] {
        signals_.emplace(derive_());
        thresholds_ = measure_thresholds(surface_, *signals_, {});
    });
    std::vector<Field> computed;
    for (const std::string_view name : names) {
        const auto row =
            std::find_if(table_.begin(), table_.end(), [&](const QualityFieldRow& r) { return r.name == name; });
        computed.push_back(compute_row(*row, surface_, *signals_, thresholds_, points));
    }
    return computed;
}

Column<float> speed_differences(const ClSurface& surface, const Signals& signals) {
    return speed_differences(surface, signals, {0, surface.positions.size() - 1});
}

Column<float> speed_differences(const ClSurface& surface, const Signals& signals, const PointRange& points) {
    Column<float> differences(static_cast<std::size_t>(points.size()), missing<float>);
    for_each_block(points, [&](PointIndex first, PointIndex last) {
        for (PointIndex i = first; i < last; ++i) {
            if (signals[i].zone != Zone::outside)
                differences[static_cast<std::size_t>(i - points.first)] = speed_difference(surface, signals, i);
        }
    });
    return differences;
}

}  // namespace clsurf
