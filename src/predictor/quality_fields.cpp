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

/// The differences to both neighbours, the larger one.
template <typename Difference>
float largest_beside(const ClSurface& surface, const Signals& signals, PointIndex i, Difference&& difference) {
    float most = missing<float>;
    for (const Side side : {Side::left, Side::right}) {
        const PathLocation at = beside(surface, {i, 0}, signals.feed(i), side);
        if (!at.exists()) continue;
        const float d = difference(at);
        if (!(std::abs(most) >= std::abs(d))) most = d == d ? d : most;
    }
    return most;
}

float speed_mismatch(const ClSurface& surface, const Signals& signals, PointIndex i) {
    const float own = signals[i].speed;
    return largest_beside(surface, signals, i, [&](const PathLocation& at) {
        return own - compared_at(signals, at, signals.normal(i)).speed;
    });
}

float acceleration_mismatch(const ClSurface& surface, const Signals& signals, PointIndex i) {
    const Eigen::Vector3f own = signals.acceleration(i);
    return largest_beside(surface, signals, i, [&](const PathLocation& at) {
        return (own - compared_at(signals, at, signals.normal(i)).acceleration).norm();
    });
}

float height(const ClSurface&, const Signals& signals, PointIndex i) {
    return signals.measured ? signals[i].lag : signals[i].relief;
}

constexpr auto quality_rows = std::to_array<QualityFieldRow>({
    {"speed_mismatch",
     "Speed against the passes beside it",
     {},
     unit::mm_min,
     FieldScale::diverging,
     &Signals::speed_note,
     speed_mismatch,
     {"mismatch"},
     7,
     true},
    {"acceleration_mismatch",
     "Acceleration against the passes beside it",
     {},
     unit::mm_s2,
     FieldScale::sequential,
     &Signals::acceleration_note,
     acceleration_mismatch,
     {},
     8,
     true},
    {"height",
     "Height over the commanded surface",
     "Height over the chord between the passes beside it",
     unit::um,
     FieldScale::diverging,
     &Signals::height_note,
     height,
     {},
     9,
     true},
});

FieldInfo info_of(const QualityFieldRow& row) {
    FieldInfo info{std::string(row.name), std::string(row.label), row.unit, row.scale, {}};
    if (!row.also.empty()) info.also.emplace_back(row.also);
    info.report_rank = row.report_rank;
    info.percentiles = row.percentiles;
    return info;
}

Field compute_row(const QualityFieldRow& row, const ClSurface& surface, const Signals& signals, PointRange points) {
    Field field;
    field.info = info_of(row);
    if (!signals.measured && !row.label_unmeasured.empty()) field.info.label = row.label_unmeasured;
    field.values.resize(static_cast<std::size_t>(points.size()));
    std::vector<PointIndex> with(static_cast<std::size_t>((points.size() + block_points - 1) / block_points));
    for_each_block(points.size(), [&](PointIndex first, PointIndex last) {
        for (PointIndex i = first; i < last; ++i) {
            const PointIndex point = points.first + i;
            const bool compared = signals[point].zone != Zone::outside;
            const float value = compared ? row.value(surface, signals, point) : missing<float>;
            field.values[static_cast<std::size_t>(i)] = value;
            if (value == value) ++with[static_cast<std::size_t>(first / block_points)];
        }
    });
    PointIndex known = 0;
    for (const PointIndex n : with) known += n;
    PointIndex cutting = 0;
    for (const Pass& pass : surface.passes) cutting += pass.kind == PassKind::cut ? pass.size() : 0;
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
    std::call_once(derived_, [&] { signals_.emplace(derive_()); });
    std::vector<Field> computed;
    for (const std::string_view name : names) {
        const auto row =
            std::find_if(table_.begin(), table_.end(), [&](const QualityFieldRow& r) { return r.name == name; });
        computed.push_back(compute_row(*row, surface_, *signals_, points));
    }
    return computed;
}

Column<float> speed_mismatches(const ClSurface& surface, const Signals& signals) {
    return compute_row(quality_rows[0], surface, signals, {0, surface.positions.size() - 1}).values;
}

}  // namespace clsurf
