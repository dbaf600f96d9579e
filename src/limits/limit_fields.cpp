#include "limits/limit_fields.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/block.h"
#include "core/error.h"
#include "core/not_finite.h"

namespace clsurf {
namespace {

/// Writes the greatest share of some limits at each point of a block.
void write_shares(const MotionWindow& window, const CommandedMotion& motion, std::span<const StatedLimit> limits,
                  std::span<float> out) {
    std::fill(out.begin(), out.end(), missing<float>);
    for (const StatedLimit& limit : limits) {
        const std::vector<MeasuredValue> measured = window.measure(limit, strides_for(limit, motion));
        for (std::size_t i = 0; i < out.size(); ++i) {
            const auto share = static_cast<float>(measured[i].value / limit.value);
            if (share == share && !(out[i] >= share)) out[i] = share;
        }
    }
}

}  // namespace

LimitFields::LimitFields(Log log, Trajectory path, std::vector<StatedLimit> limits)
    : log_(std::move(log)), path_(std::move(path)), limits_(std::move(limits)) {}

std::vector<LimitFields::Row> LimitFields::rows() {
    std::vector<Row> rows;
    for (const LimitedQuantity quantity :
         {LimitedQuantity::speed, LimitedQuantity::acceleration, LimitedQuantity::jerk}) {
        const std::string name = std::string(row_of(quantity).name);
        std::string label = name;
        label.front() = static_cast<char>(label.front() - 'a' + 'A');
        const auto add = [&](const std::string& suffix, const std::string& of, char axis) {
            FieldInfo info;
            info.name = name + "_share" + suffix;
            info.label = label + " " + of + " as a share of its limit";
            info.axis = axis;
            info.note = "unsmoothed differences";
            info.preference = FieldPreference::lower;
            info.usual_range = ValueRange{0, 1};
            rows.push_back({info, quantity});
        };
        add("", "of the worst axis", 0);
        for (const char axis : {'x', 'y', 'z', 'a', 'b', 'c'})
            add(std::string(".") + axis, std::string("of axis ") + static_cast<char>(axis - 'a' + 'A'), axis);
    }
    return rows;
}

std::vector<FieldInfo> LimitFields::fields() const {
    std::vector<FieldInfo> infos;
    for (Row& row : rows()) {
        row.info.note.clear();
        infos.push_back(std::move(row.info));
    }
    return infos;
}

std::vector<StatedLimit> LimitFields::limits_of(const Row& row) const {
    std::vector<StatedLimit> limits;
    for (const StatedLimit& limit : limits_) {
        if (limit.quantity != row.quantity || (row.info.axis != 0 && row.info.axis != limit.axis)) continue;
        if (log_.find(std::string("cmd.") + limit.axis) != nullptr) limits.push_back(limit);
    }
    return limits;
}

bool LimitFields::can_compute(std::string_view name) const {
    const std::vector<Row> all = rows();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Row& row) { return row.info.name == name; });
    return found != all.end() && !limits_of(*found).empty();
}

std::vector<Field> LimitFields::compute(std::span<const std::string_view> names, PointRange points) const {
    const std::vector<Row> all = rows();
    std::vector<Field> fields;
    std::vector<std::vector<StatedLimit>> limits;
    for (const std::string_view name : names) {
        const auto row = std::find_if(all.begin(), all.end(), [&](const Row& r) { return r.info.name == name; });
        limits.push_back(limits_of(*row));
        if (limits.back().empty())
            throw UsageError(
                "the field '" + std::string(name) + "' needs commanded positions and the limits of the axes",
                "--machine FILE, with " + std::string(row_of(row->quantity).key) + " of its axes");
        fields.push_back({row->info, Column<float>(static_cast<std::size_t>(points.size()))});
    }
    const CommandedMotion motion(log_, path_, limits_);
    for_each_block(points.size(), [&](PointIndex first, PointIndex end) {
        const MotionWindow window(motion, {points.first + first, points.first + end - 1});
        const auto begin = static_cast<std::size_t>(first), size = static_cast<std::size_t>(end - first);
        for (std::size_t f = 0; f < fields.size(); ++f)
            write_shares(window, motion, limits[f], std::span<float>(fields[f].values.data() + begin, size));
    });
    return fields;
}

}  // namespace clsurf
