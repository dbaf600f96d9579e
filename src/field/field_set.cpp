#include "field/field_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "core/block.h"
#include "core/error.h"
#include "core/spelling.h"
#include "field/field_table.h"
#include "numeric/derivative.h"
#include "surface/smoothing_segments.h"

namespace clsurf {
namespace {

constexpr PointIndex stretch_points = 4096;  ///< of a block, worked on at once: fits the L1 cache
constexpr PointIndex error_halo = 256;       ///< commanded points that the contour error looks round

/// Positions of one role with room round them, and what is derived from them.
struct Scratch {
    std::array<std::vector<double>, 3> samples;
    std::array<std::array<std::vector<double>, 3>, 3> derived;  ///< by derivative − 1, axis
    std::array<std::vector<double>, 3> commanded, measured;
    MotionEstimate::Scratch estimate;
    std::array<std::array<std::vector<double>, 3>, 4> estimated;  ///< by derivative, axis
    std::vector<double> uncertainty;
};

void read(const Trajectory& path, PointIndex first, PointIndex last, std::array<std::vector<double>, 3>& out) {
    for (std::vector<double>& axis : out) axis.resize(static_cast<std::size_t>(last - first + 1));
    path.read(first, out[0], out[1], out[2]);
}

}  // namespace

FieldSet::FieldSet(const Log& log, const Trajectory& path, const Passes& passes, Derivation derivation)
    : log_(log), path_(path), pieces_(smooth_pieces(log, passes)), derivation_(std::move(derivation)) {
    if (derivation_.coarsest_period == 0) pieces_ = split_at_standstills(pieces_, path);
}

namespace {

/// What the rows of one request need, made once.
struct Plan {
    std::array<std::optional<Differentiator>, 3> derivatives;
    std::optional<Trajectory> commanded, measured;
    std::optional<Trajectory> other;           ///< what is derived in place of the path's positions
    const MotionEstimate* estimate = nullptr;  ///< what derives the path's positions; nullptr: the filters above
    int derivative = 0;                        ///< the highest that is needed
    PointIndex reach = 0;
};

constexpr unsigned all_derivatives = needs::velocity | needs::acceleration | needs::jerk;

Plan plan_for(const FieldRow& row, const Log& log, const Trajectory& path, const Derivation& derivation) {
    const MotionEstimate* estimate = derivation.estimate.get();
    Plan plan;
    if ((row.needs & needs::uncertainty) != 0 && estimate == nullptr) {
        throw UsageError(fmt::format("field '{}' is what a Kalman smoother leaves open", row.name),
                         "--derivative kalman");
    }
    // Angles and tool axes have no measured speeds.
    if ((row.needs & all_derivatives) != 0 && (row.needs & (needs::angle | needs::tool_axis)) == 0)
        plan.estimate = estimate;
    const bool of_axis = (row.needs & needs::tool_axis) != 0;
    if (of_axis && path.kinematics == nullptr) {
        throw UsageError(fmt::format("field '{}' needs the kinematics of a machine with rotary axes", row.name),
                         "--machine FILE says them");
    }
    for (int d = 1; d <= 3; ++d) {
        if ((row.needs & (needs::velocity << (d - 1))) == 0) continue;
        plan.derivative = d;
        if (plan.estimate != nullptr) continue;
        plan.derivatives[static_cast<std::size_t>(d - 1)].emplace(
            derivative_filter(d, log.period, derivation.coarsest_period));
        plan.reach = std::max(plan.reach, plan.derivatives[static_cast<std::size_t>(d - 1)]->reach());
    }
    if ((row.needs & needs::error) != 0) {
        const Role measured = path.role == Role::commanded ? Role::feedback : path.role;
        for (const Role role : {Role::commanded, measured}) {
            if (log.has(role)) continue;
            throw UsageError(
                fmt::format("field '{}' needs {} positions, which the log does not have", row.name, name_of(role)));
        }
        const auto positions = [&](Role role) {
            return of_axis ? tool_axes(log, role, path) : reconstruct_like(log, role, path);
        };
        plan.commanded = positions(Role::commanded);
        plan.measured = positions(measured);
    } else if (of_axis) {
        plan.other = tool_axes(log, path.role, path);
    } else if ((row.needs & needs::angle) != 0) {
        const char letter = row.name.back();
        if (log.find(fmt::format("{}.{}", prefix_of(path.role), letter)) == nullptr) {
            throw UsageError(fmt::format("field '{}' needs {} positions of axis {}, which the log does not have",
                                         row.name, name_of(path.role), letter));
        }
        plan.other = axis_angle(log, path.role, letter);
    }
    return plan;
}

/// Values of points [first, last] of a piece.
void compute_stretch(const FieldRow& row, const Plan& plan, const Trajectory& path, PointRange piece, PointIndex first,
                     PointIndex last, Scratch& scratch, float* out) {
    FieldBlock block{};
    block.first = first;
    block.count = static_cast<std::size_t>(last - first + 1);
    block.period = path.period;
    if ((row.needs & needs::uncertainty) != 0) {
        scratch.uncertainty.resize(block.count);
        plan.estimate->sigmas(plan.derivative, piece, first, scratch.uncertainty);
        block.uncertainty = scratch.uncertainty.data();
        row.compute(block, out);
        return;
    }
    if (plan.estimate != nullptr) {
        plan.estimate->estimate(piece, first, last, scratch.estimate, scratch.estimated);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            block.position[axis] = scratch.estimated[0][axis].data();
            block.velocity[axis] = scratch.estimated[1][axis].data();
            block.acceleration[axis] = scratch.estimated[2][axis].data();
            block.jerk[axis] = scratch.estimated[3][axis].data();
        }
        row.compute(block, out);
        return;
    }
    const Trajectory& derived = plan.other ? *plan.other : path;
    if ((row.needs & (needs::position | needs::velocity | needs::acceleration | needs::jerk)) != 0) {
        const PointIndex from = std::max(piece.first, first - plan.reach);
        const PointIndex to = std::min(piece.last, last + plan.reach);
        read(derived, from, to, scratch.samples);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            block.position[axis] = scratch.samples[axis].data() + (first - from);
            for (std::size_t d = 0; d < 3; ++d) {
                if (!plan.derivatives[d]) continue;
                std::vector<double>& values = scratch.derived[d][axis];
                values.resize(block.count);
                plan.derivatives[d]->apply(scratch.samples[axis], from, piece, first, values);
                (d == 0 ? block.velocity : d == 1 ? block.acceleration : block.jerk)[axis] = values.data();
            }
        }
    }
    if (plan.commanded) {
        // Missing points at the ends repeat the end, where the tool rests.
        const PointIndex from = std::max<PointIndex>(0, first - error_halo);
        const PointIndex to = std::min(path.count - 1, last + 16);
        read(*plan.measured, first, last, scratch.measured);
        std::array<std::vector<double>, 3> inside;
        read(*plan.commanded, from, to, inside);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::vector<double>& all = scratch.commanded[axis];
            all.assign(static_cast<std::size_t>(last + 16 - (first - error_halo) + 1), inside[axis].back());
            const auto lead = static_cast<std::ptrdiff_t>(from - (first - error_halo));
            std::fill(all.begin(), all.begin() + lead, inside[axis].front());
            std::copy(inside[axis].begin(), inside[axis].end(), all.begin() + lead);
            block.commanded[axis] = all.data() + error_halo;
            block.measured[axis] = scratch.measured[axis].data();
        }
    }
    row.compute(block, out);
}

void compute_range(const FieldRow& row, const Plan& plan, const Trajectory& path, const std::vector<PointRange>& pieces,
                   PointRange points, float* out) {
    Scratch scratch;
    auto piece = std::upper_bound(pieces.begin(), pieces.end(), points.first,
                                  [](PointIndex p, const PointRange& r) { return p < r.first; });
    if (piece != pieces.begin()) --piece;
    for (PointIndex first = points.first; first <= points.last;) {
        while (piece != pieces.end() && piece->last < first) ++piece;
        const PointRange inside = piece == pieces.end() ? PointRange{first, points.last} : *piece;
        const PointIndex last = std::min({points.last, inside.last, first + stretch_points - 1});
        compute_stretch(row, plan, path, inside, first, last, scratch, out + (first - points.first));
        first = last + 1;
    }
}

FieldInfo info_of(const FieldRow& row, const Log* log, double coarsest = 0) {
    FieldInfo info{std::string(row.name), std::string(row.label), row.unit, row.scale, {}};
    if (log == nullptr) return info;
    for (int d = 3; d >= 1; --d) {
        if ((row.needs & (needs::velocity << (d - 1))) == 0) continue;
        const DerivativeFilter filter = derivative_filter(d, log->period, coarsest);
        info.note = fmt::format("{}-point window ({:.3g} ms, \u22123 dB at {:.0f} Hz)", filter.points,
                                filter.points * filter.period * 1e3, filter.bandwidth());
        break;
    }
    return info;
}

/// The log's channel behind a field name: its own name, or `log.NAME` where a field has that name.
const Channel* channel_of(const Log& log, std::string_view name) {
    if (name.starts_with("log.")) {
        if (const Channel* channel = log.find(name.substr(4))) return channel;
    }
    return log.find(name);
}

FieldInfo info_of(const Channel& channel, std::string_view name) {
    // Channels are shown as they were recorded.
    return {std::string(name), "Channel " + channel.name, FieldUnit(channel.unit), FieldScale::sequential, {}};
}

}  // namespace

void unknown_field(std::string_view name, const std::vector<FieldInfo>& fields) {
    std::vector<std::string_view> names;
    for (const FieldInfo& f : fields) names.push_back(f.name);
    const std::string nearest = did_you_mean(name, names);
    throw UsageError("unknown field '" + std::string(name) + "'",
                     nearest.empty() ? "`clsurf help fields` lists them" : nearest);
}

bool FieldSet::has(std::string_view name) const {
    return find_field_row(name) != nullptr || name == "time" || channel_of(log_, name) != nullptr;
}

Field FieldSet::get(std::string_view name) const {
    Field field;
    field.values.resize(static_cast<std::size_t>(log_.records));
    if (const FieldRow* row = find_field_row(name)) {
        field.info = info_of(*row, &log_, derivation_.coarsest_period);
        const bool of_path = (row->needs & (needs::angle | needs::tool_axis)) == 0;
        for (int d = 3; derivation_.estimate && of_path && d >= 1; --d) {
            if ((row->needs & (needs::velocity << (d - 1))) == 0) continue;
            field.info.note = derivation_.estimate->note(d);
            break;
        }
        const Plan plan = plan_for(*row, log_, path_, derivation_);
        for_each_block(log_.records, [&](PointIndex first, PointIndex last) {
            compute_range(*row, plan, path_, pieces_, {first, last - 1}, field.values.data() + first);
        });
        return field;
    }
    if (name == "time") {
        field.info = {"time", "Time", unit::s, FieldScale::sequential, {}};
        for_each_block(log_.records, [&](PointIndex first, PointIndex last) {
            for (PointIndex i = first; i < last; ++i)
                field.values[static_cast<std::size_t>(i)] = static_cast<float>(log_.time_of(i));
        });
        return field;
    }
    const Channel* channel = channel_of(log_, name);
    if (channel == nullptr) unknown_field(name, known_fields(&log_));
    field.info = info_of(*channel, name);
    for_each_block(log_.records, [&](PointIndex first, PointIndex last) {
        std::array<double, 2048> scratch;
        for (PointIndex begin = first; begin < last; begin += 2048) {
            const auto n = static_cast<std::size_t>(std::min<PointIndex>(2048, last - begin));
            copy_block(channel->values, begin, {scratch.data(), n});
            for (std::size_t i = 0; i < n; ++i)
                field.values[static_cast<std::size_t>(begin) + i] = static_cast<float>(scratch[i]);
        }
    });
    return field;
}

std::vector<double> FieldSet::values(std::string_view name, PointRange points) const {
    const FieldRow* row = find_field_row(name);
    if (row == nullptr) unknown_field(name, known_fields(&log_));
    std::vector<float> computed(static_cast<std::size_t>(points.size()));
    compute_range(*row, plan_for(*row, log_, path_, derivation_), path_, pieces_, points, computed.data());
    return {computed.begin(), computed.end()};
}

std::vector<FieldInfo> known_fields(const Log* log) {
    std::vector<FieldInfo> fields;
    for (const FieldRow& row : field_table()) fields.push_back(info_of(row, log));
    fields.push_back({"time", "Time", unit::s, FieldScale::sequential, {}});
    if (log == nullptr) return fields;
    for (const Channel& channel : log->channels) {
        const bool taken =
            std::any_of(fields.begin(), fields.end(), [&](const FieldInfo& f) { return f.name == channel.name; });
        fields.push_back(info_of(channel, taken ? "log." + channel.name : channel.name));
    }
    return fields;
}

}  // namespace clsurf
