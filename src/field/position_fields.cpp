#include "field/position_fields.h"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "core/block.h"
#include "core/error.h"
#include "core/point_count.h"
#include "field/path_curvature.h"
#include "numeric/derivative.h"
#include "surface/smoothing_segments.h"
#include "toolpath/tool_axes.h"

namespace clsurf {
namespace {

constexpr PointIndex section_points = 4096;  ///< points processed at once, so that they fit the L1 cache

constexpr unsigned bit_of_derivative(int d) { return needs::velocity << (d - 1); }
constexpr unsigned bit_of_sigma(int d) { return needs::velocity_sigma << (d - 1); }

using Columns = std::array<std::vector<double>, 3>;

/// The values to be differentiated, read by block.
class Samples {
public:
    explicit Samples(Trajectory path) : path_(std::move(path)) {}
    explicit Samples(ToolAxes axes) : tool_axes_(std::move(axes)) {}
    explicit Samples(const ChannelView& angles) : angles_(angles) {}

    [[nodiscard]] std::size_t components() const { return angles_ ? 1 : 3; }
    void read(PointIndex first, PointIndex last, Columns& out) const {
        for (std::vector<double>& axis : out) axis.resize(static_cast<std::size_t>(last - first + 1));
        if (path_) {
            path_->read(first, out[0], out[1], out[2]);
        } else if (tool_axes_) {
            tool_axes_->read(first, out[0], out[1], out[2]);
        } else {
            copy_block(*angles_, first, out[0]);
        }
    }

private:
    std::optional<Trajectory> path_;
    std::optional<ToolAxes> tool_axes_;
    std::optional<ChannelView> angles_;  ///< [rad]
};

/// A requested row, and the target of its values.
struct Wanted {
    const FieldRow* row = nullptr;
    float* out = nullptr;  ///< value of the first requested point
};

/// Rows that share positions and derivatives, and their inputs, computed once.
struct Plan {
    std::vector<Wanted> rows;
    FieldSubject subject = FieldSubject::tip;
    char axis = 0;          ///< of a rotary axis
    bool smoothed = false;  ///< positions and derivatives are those of the estimate
    unsigned needs = 0;     ///< needs of all rows
    const Log* log = nullptr;
    const MotionEstimate* estimate = nullptr;
    PointIndex count = 0;  ///< of the log
    std::optional<Samples> samples, commanded, measured;
    std::optional<PathCurvature> curvature;
    std::array<std::optional<Differentiator>, 3> derivatives;
    PointIndex reach = 0;

    [[nodiscard]] bool takes(const FieldRow& row, bool by_estimate) const {
        return row.subject == subject && by_estimate == smoothed &&
               (subject != FieldSubject::rotary_axis || row.axis == axis);
    }
};

/// Angles and tool axes have no measured speeds. Positions are as recorded, unless they are fused.
bool is_smoothed(const FieldRow& row, const Derivation& derivation) {
    if (!derivation.estimate || row.subject != FieldSubject::tip) return false;
    const unsigned positions = derivation.estimate->fused() != nullptr ? needs::position : 0;
    return (row.needs & (needs::derivatives | needs::sigmas | positions)) != 0;
}

Role measured_role_of(const Trajectory& path) { return path.role == Role::commanded ? Role::feedback : path.role; }

/// The reason why a row cannot be computed; nullopt: it can be computed.
std::optional<UsageError> refusal(const FieldRow& row, const Log& log, const Trajectory& path,
                                  const Derivation& derivation) {
    if ((row.needs & needs::sigmas) != 0 && !derivation.estimate)
        return UsageError(fmt::format("field '{}' is the standard deviation of a Kalman smoother's estimate", row.name),
                          "--derivative kalman");
    if ((row.needs & needs::position_sigma) != 0 && derivation.estimate->fused() == nullptr)
        return UsageError(
            fmt::format("field '{}' needs an estimate from the scale and the encoder of each axis", row.name),
            "--surface actual, with feedback and actual positions in the log");
    if (row.subject == FieldSubject::tool_axis && path.kinematics == nullptr)
        return UsageError(fmt::format("field '{}' needs the kinematics of a machine with rotary axes", row.name),
                          "give them with --machine FILE");
    if ((row.needs & needs::error) != 0) {
        for (const Role role : {Role::commanded, measured_role_of(path)}) {
            if (!log.has(role))
                return UsageError(
                    fmt::format("field '{}' needs {} positions, which the log does not have", row.name, name_of(role)));
        }
    }
    if (row.subject == FieldSubject::rotary_axis &&
        log.find(fmt::format("{}.{}", prefix_of(path.role), row.axis)) == nullptr)
        return UsageError(fmt::format("field '{}' needs {} positions of axis {}, which the log does not have", row.name,
                                      name_of(path.role), row.axis));
    return std::nullopt;
}

/// The values that a plan's rows are computed from.
Samples samples_of(const Plan& plan, const Trajectory& path) {
    switch (plan.subject) {
        case FieldSubject::tool_axis: return Samples(tool_axes(*plan.log, path.role, path));
        case FieldSubject::rotary_axis: return Samples(axis_angles(*plan.log, path.role, plan.axis));
        case FieldSubject::tip: break;
    }
    return Samples(path);
}

void complete(Plan& plan, const Trajectory& path, const Derivation& derivation) {
    plan.count = path.count;
    for (const Wanted& wanted : plan.rows) plan.needs |= wanted.row->needs;
    if (!plan.smoothed && (plan.needs & (needs::position | needs::derivatives)) != 0)
        plan.samples = samples_of(plan, path);
    for (int d = 1; d <= 3 && !plan.smoothed; ++d) {
        if ((plan.needs & bit_of_derivative(d)) == 0) continue;
        auto& filter = plan.derivatives[static_cast<std::size_t>(d - 1)];
        filter.emplace(derivation.filter(d, plan.log->period));
        plan.reach = std::max(plan.reach, filter->reach());
    }
    if ((plan.needs & needs::curvature) != 0) plan.curvature.emplace(*plan.log, path);
    if ((plan.needs & needs::error) == 0) return;
    const auto positions = [&](Role role) {
        return plan.subject == FieldSubject::tool_axis ? Samples(tool_axes(*plan.log, role, path))
                                                       : Samples(reconstruct_like(*plan.log, role, path));
    };
    plan.commanded = positions(Role::commanded);
    plan.measured = positions(measured_role_of(path));
}

/// Fills the inputs of a plan's rows at points [first, last] of a piece, and runs their kernels. Keeps its memory.
class Section {
public:
    Section(const Plan& plan, PointIndex origin) : plan_(plan), origin_(origin) {}

    void compute(PointRange piece, PointIndex first, PointIndex last) {
        first_ = first;
        last_ = last;
        count_ = static_cast<std::size_t>(last - first + 1);
        filled_.fill({});
        if (plan_.smoothed) fill_smoothed(piece);
        if (plan_.samples) fill_derived(piece);
        if (plan_.commanded) fill_error();
        fill_scalars(piece);
        for (const Wanted& wanted : plan_.rows) {
            // A row gets only its own inputs, not those of the others.
            FieldBlock block(*wanted.row, count_);
            for (unsigned bit = 0; bit < needs::kinds; ++bit) {
                if ((wanted.row->needs & (1U << bit)) != 0) block.set(1U << bit, filled_[bit]);
            }
            wanted.row->compute(block, wanted.out + (first - origin_));
        }
    }

private:
    void fill(unsigned need, const FieldBlock::Vector& columns) {
        for (unsigned bit = 0; bit < needs::kinds; ++bit) {
            if (need == 1U << bit) filled_[bit] = columns;
        }
    }

    void fill_smoothed(PointRange piece) {
        plan_.estimate->estimate(piece, first_, last_, scratch_, estimated_);
        for (unsigned d = 0; d <= 3; ++d) {
            const auto& of = estimated_[d];
            fill(needs::position << d, {of[0].data(), of[1].data(), of[2].data()});
        }
    }

    void fill_derived(PointRange piece) {
        const PointIndex from = std::max(piece.first, first_ - plan_.reach);
        const PointIndex to = std::min(piece.last, last_ + plan_.reach);
        plan_.samples->read(from, to, samples_);
        const std::size_t components = plan_.samples->components();
        FieldBlock::Vector position{};
        for (std::size_t axis = 0; axis < components; ++axis) position[axis] = samples_[axis].data() + (first_ - from);
        fill(needs::position, position);
        for (std::size_t d = 0; d < 3; ++d) {
            if (!plan_.derivatives[d]) continue;
            FieldBlock::Vector derived{};
            for (std::size_t axis = 0; axis < components; ++axis) {
                std::vector<double>& values = derived_[d][axis];
                values.resize(count_);
                plan_.derivatives[d]->apply(samples_[axis], from, piece, first_, values);
                derived[axis] = values.data();
            }
            fill(needs::velocity << d, derived);
        }
    }

    /// Missing points at the ends repeat the end point, where the tool is at rest.
    void fill_error() {
        constexpr PointIndex before = FieldBlock::commanded_before;
        constexpr PointIndex after = FieldBlock::commanded_after;
        const PointIndex from = std::max<PointIndex>(0, first_ - before);
        const PointIndex to = std::min(plan_.count - 1, last_ + after);
        plan_.measured->read(first_, last_, measured_);
        plan_.commanded->read(from, to, inside_);
        FieldBlock::Vector commanded{};
        FieldBlock::Vector measured{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::vector<double>& inside = inside_[axis];
            std::vector<double>& all = commanded_[axis];
            all.assign(static_cast<std::size_t>(before + after) + count_, inside.back());
            const auto lead = static_cast<std::ptrdiff_t>(from - (first_ - before));
            std::fill(all.begin(), all.begin() + lead, inside.front());
            std::copy(inside.begin(), inside.end(), all.begin() + lead);
            commanded[axis] = all.data() + before;
            measured[axis] = measured_[axis].data();
        }
        fill(needs::commanded, commanded);
        fill(needs::measured, measured);
    }

    void fill_scalars(PointRange piece) {
        for (int d = 1; d <= 3; ++d) {
            if ((plan_.needs & bit_of_sigma(d)) == 0) continue;
            std::vector<double>& values = sigmas_[static_cast<std::size_t>(d - 1)];
            values.resize(count_);
            plan_.estimate->sigmas(d, piece, first_, scratch_, values);
            fill(bit_of_sigma(d), {values.data()});
        }
        if ((plan_.needs & needs::position_sigma) != 0) {
            for (std::vector<double>& axis : position_sigmas_) axis.resize(count_);
            plan_.estimate->position_sigmas(piece, first_, scratch_, position_sigmas_);
            fill(needs::position_sigma,
                 {position_sigmas_[0].data(), position_sigmas_[1].data(), position_sigmas_[2].data()});
        }
        if (plan_.curvature) {
            curvature_.resize(count_);
            plan_.curvature->compute(first_, curvature_);
            fill(needs::curvature, {curvature_.data()});
        }
        if ((plan_.needs & needs::time) == 0) return;
        time_.resize(count_);
        for (std::size_t i = 0; i < count_; ++i) time_[i] = plan_.log->time_of(first_ + static_cast<PointIndex>(i));
        fill(needs::time, {time_.data()});
    }

    const Plan& plan_;
    PointIndex origin_;  ///< of the rows' values
    PointIndex first_ = 0, last_ = 0;
    std::size_t count_ = 0;
    std::array<FieldBlock::Vector, needs::kinds> filled_{};  ///< by the number of the bit
    Columns samples_, commanded_, measured_, inside_, sigmas_, position_sigmas_;
    std::array<Columns, 3> derived_;  ///< by derivative − 1
    std::array<Columns, 4> estimated_;
    MotionEstimate::Scratch scratch_;
    std::vector<double> time_, curvature_;
};

/// `origin`: the point of the first value.
void compute_range(const Plan& plan, const std::vector<PointRange>& pieces, PointRange points, PointIndex origin) {
    Section section(plan, origin);
    auto piece = std::upper_bound(pieces.begin(), pieces.end(), points.first,
                                  [](PointIndex p, const PointRange& r) { return p < r.first; });
    if (piece != pieces.begin()) --piece;
    for (PointIndex first = points.first; first <= points.last;) {
        while (piece != pieces.end() && piece->last < first) ++piece;
        const PointRange inside = piece == pieces.end() ? PointRange{first, points.last} : *piece;
        const PointIndex last = std::min({points.last, inside.last, first + section_points - 1});
        section.compute(inside, first, last);
        first = last + 1;
    }
}

std::vector<PointRange> pieces_of(const Log& log, const Trajectory& path, const Passes& passes, double coarsest) {
    std::vector<PointRange> pieces = smoothing_segments(log, passes);
    return coarsest == 0 ? split_at_standstills(pieces, path) : pieces;
}

}  // namespace

DerivativeFilter Derivation::filter(int derivative, double period) const {
    DerivativeFilter filter = derivative_filter(derivative, period, coarsest_period);
    if (derivative == 3 && jerk_window > 0) filter.points = window_points(jerk_window, period, filter.order + 2);
    return filter;
}

PositionFields::PositionFields(const Log& log, const Trajectory& path, const Passes& passes, Derivation derivation,
                               std::span<const FieldRow> rows)
    : log_(std::make_shared<const Log>(log)),
      path_(path),
      pieces_(pieces_of(log, path, passes, derivation.coarsest_period)),
      derivation_(std::move(derivation)),
      rows_(rows) {}

PositionFields PositionFields::within(const Passes& passes) const {
    PositionFields other = *this;
    other.pieces_ = pieces_of(*log_, path_, passes, derivation_.coarsest_period);
    return other;
}

std::vector<FieldInfo> PositionFields::fields() const {
    std::vector<FieldInfo> infos;
    for (const FieldRow& row : rows_) infos.push_back(info_of(row));
    return infos;
}

bool PositionFields::can_compute(std::string_view name) const { return !refusal(row(name), *log_, path_, derivation_); }

const FieldRow& PositionFields::row(std::string_view name) const {
    return *std::find_if(rows_.begin(), rows_.end(), [&](const FieldRow& row) { return row.name == name; });
}

std::string PositionFields::note_of(const FieldRow& row) const {
    const int d = derivative_of(row);
    if (d == 0) return is_smoothed(row, derivation_) ? derivation_.estimate->note(d) : std::string();
    if (derivation_.estimate && row.subject == FieldSubject::tip) return derivation_.estimate->note(d);
    const DerivativeFilter filter = derivation_.filter(d, log_->period);
    return fmt::format("{}-point window ({:.3g} ms, \u22123 dB at {:.0f} Hz)", filter.points,
                       filter.points * filter.period * 1e3, filter.bandwidth());
}

std::vector<Field> PositionFields::compute(std::span<const std::string_view> names, PointRange points) const {
    std::vector<Field> computed;
    std::vector<Plan> plans;
    computed.reserve(names.size());
    for (const std::string_view name : names) {
        const FieldRow& asked = row(name);
        if (const std::optional<UsageError> error = refusal(asked, *log_, path_, derivation_)) throw UsageError(*error);
        Field& field = computed.emplace_back();
        field.info = info_of(asked);
        field.info.note = note_of(asked);
        field.values.resize(static_cast<std::size_t>(points.size()));
        const bool smoothed = is_smoothed(asked, derivation_);
        auto plan = std::find_if(plans.begin(), plans.end(), [&](const Plan& p) { return p.takes(asked, smoothed); });
        if (plan == plans.end()) {
            plan = plans.emplace(plans.end());
            plan->subject = asked.subject;
            plan->axis = asked.axis;
            plan->smoothed = smoothed;
            plan->log = log_.get();
            plan->estimate = derivation_.estimate.get();
        }
        plan->rows.push_back({&asked, field.values.data()});
    }
    for (Plan& plan : plans) {
        complete(plan, path_, derivation_);
        for_each_block(points.size(), [&](PointIndex first, PointIndex last) {
            compute_range(plan, pieces_, {points.first + first, points.first + last - 1}, points.first);
        });
    }
    return computed;
}

}  // namespace clsurf
