#include "predictor/quality_fields.h"

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
        const Station at = beside(surface, {i, 0}, signals.feed(i), side);
        if (!at.exists()) continue;
        const float d = difference(at);
        if (!(std::abs(most) >= std::abs(d))) most = d == d ? d : most;
    }
    return most;
}

float speed_mismatch(const ClSurface& surface, const Signals& signals, PointIndex i) {
    const float own = signals[i].speed;
    return largest_beside(surface, signals, i,
                          [&](const Station& at) { return own - compared_at(signals, at, signals.normal(i)).speed; });
}

float acceleration_mismatch(const ClSurface& surface, const Signals& signals, PointIndex i) {
    const Eigen::Vector3f own = signals.acceleration(i);
    return largest_beside(surface, signals, i, [&](const Station& at) {
        return (own - compared_at(signals, at, signals.normal(i)).acceleration).norm();
    });
}

float height(const ClSurface&, const Signals& signals, PointIndex i) {
    return signals.measured ? signals[i].lag : signals[i].relief;
}

struct Row {
    FieldInfo info;
    std::string Signals::*windows;
    float (*value)(const ClSurface&, const Signals&, PointIndex);
};

const std::array<Row, 3>& table() {
    static const std::array<Row, 3> rows{
        Row{{"speed_mismatch", "Speed against the passes beside it", unit::mm_min, FieldScale::diverging, {}},
            &Signals::speed_note,
            speed_mismatch},
        Row{{"acceleration_mismatch",
             "Acceleration against the passes beside it",
             unit::mm_s2,
             FieldScale::sequential,
             {}},
            &Signals::acceleration_note,
            acceleration_mismatch},
        Row{{"height", "Height over the commanded surface", unit::um, FieldScale::diverging, {}},
            &Signals::height_note,
            height},
    };
    return rows;
}

const Row* find_row(std::string_view name) {
    for (const Row& row : table()) {
        if (row.info.name == name) return &row;
    }
    return nullptr;
}

}  // namespace

std::span<const FieldInfo> quality_fields() {
    static const std::vector<FieldInfo> infos = [] {
        std::vector<FieldInfo> all;
        for (const Row& row : table()) all.push_back(row.info);
        return all;
    }();
    return infos;
}

bool is_quality_field(std::string_view name) { return find_row(name) != nullptr; }

Field quality_field(std::string_view name, const ClSurface& surface, const Signals& signals) {
    const Row& row = *find_row(name);
    Field field;
    field.info = row.info;
    if (name == "height" && !signals.measured) field.info.label = "Height over the chord between the passes beside it";
    const PointIndex count = surface.positions.size();
    field.values.resize(static_cast<std::size_t>(count));
    std::vector<PointIndex> with(static_cast<std::size_t>((count + block_points - 1) / block_points));
    for_each_block(count, [&](PointIndex first, PointIndex last) {
        for (PointIndex i = first; i < last; ++i) {
            const bool compared = signals[i].zone != Zone::outside;
            const float value = compared ? row.value(surface, signals, i) : missing<float>;
            field.values[static_cast<std::size_t>(i)] = value;
            if (value == value) ++with[static_cast<std::size_t>(first / block_points)];
        }
    });
    PointIndex known = 0;
    for (const PointIndex n : with) known += n;
    PointIndex cutting = 0;
    for (const Pass& pass : surface.passes) cutting += pass.kind == PassKind::cut ? pass.size() : 0;
    field.info.note =
        fmt::format("{}; {:.1f} % of the cutting points have a value", signals.*row.windows,
                    cutting > 0 ? 100.0 * static_cast<double>(known) / static_cast<double>(cutting) : 0.0);
    return field;
}

}  // namespace clsurf
