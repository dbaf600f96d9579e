#include "identify/limit_parameters.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/units.h"
#include "identify/axis_record.h"
#include "identify/plateaus.h"
#include "log/quantum.h"
#include "machine/limit_table.h"

namespace clsurf {
namespace {

constexpr PointIndex most_records = 4'000'000;
// As in docs/design/identify.md#limits.
constexpr std::size_t least_places = 3;
constexpr double parallel = 0.98;  ///< share of the path's value that counts as parallel to the axis

/// Commanded positions of a piece of a run, by axis; with rotary axes also positions of the tool tip; and which records are
/// rapids.
struct MotionPiece {
    std::vector<std::vector<double>> positions, tips;
    std::vector<char> rapid;
};

/// The pieces of the runs of one period.
struct PeriodMotion {
    double period = 0;  ///< [s]
    std::vector<MotionPiece> pieces;
};

struct Motion {
    std::string letters;             ///< of the axes; linear ones first
    double rounding = 0;             ///< step of the commanded positions [mm or deg]
    std::vector<double> resolution;  ///< resolution of their stored numbers, by axis [mm or deg]
    bool has_tips = false;
    double reach = 0;  ///< greatest distance of the tips from the workpiece's zero [mm]
    std::vector<PeriodMotion> parts;

    /// Number of limited quantities: one for each axis, then one for the path.
    [[nodiscard]] std::size_t quantities() const { return letters.size() + 1; }
    [[nodiscard]] std::size_t linear() const {
        return static_cast<std::size_t>(std::count_if(letters.begin(), letters.end(), [](char c) { return c >= 'x'; }));
    }
    /// The resolution of a quantity's positions, on an axis or on the path.
    [[nodiscard]] double resolution_along(std::size_t q) const {
        if (q < resolution.size()) return resolution[q];
        const auto end = resolution.begin() + static_cast<std::ptrdiff_t>(linear());
        const double of_angles = has_tips ? reach * rad_per_deg * *std::max_element(end, resolution.end()) : 0;
        return *std::max_element(resolution.begin(), end) + of_angles;
    }
};

Motion gather_motion(std::span<const IdentifyRun> runs) {
    Motion motion;
    for (const char letter : {'x', 'y', 'z', 'a', 'b', 'c'}) {
        const std::string name = std::string("cmd.") + letter;
        const bool all = std::all_of(runs.begin(), runs.end(),
                                     [&](const IdentifyRun& run) { return run.log->find(name) != nullptr; });
        if (all) motion.letters += letter;
    }
    motion.has_tips =
        motion.linear() < motion.letters.size() && std::all_of(runs.begin(), runs.end(), [](const IdentifyRun& run) {
            return run.tips != nullptr && run.tips->role == Role::commanded;
        });
    for (const IdentifyRun& run : runs) {
        std::vector<ChannelView> channels;
        for (const char letter : motion.letters)
            channels.push_back(run.log->find(std::string("cmd.") + letter)->values);
        if (channels.empty()) break;
        const std::vector<PointRange> sections = find_sections(*run.log, channels);
        motion.resolution.resize(channels.size(), 0);
        for (std::size_t k = 0; k < channels.size(); ++k) {
            motion.resolution[k] = std::max(motion.resolution[k], resolution_of(channels[k]));
            motion.rounding = std::max(motion.rounding, motion.resolution[k]);
        }
        for (const PointRange& range : sample_pieces(sections, most_records / static_cast<PointIndex>(runs.size()))) {
            const auto n = static_cast<std::size_t>(range.size());
            MotionPiece piece;
            for (const ChannelView& channel : channels)
                copy_block(channel, range.first, piece.positions.emplace_back(n));
            std::vector<PointKind> kinds(n, PointKind::idle);
            if (run.lines != nullptr) run.lines->read_kinds(range.first, kinds);
            for (const PointKind kind : kinds) piece.rapid.push_back(kind == PointKind::rapid ? 1 : 0);
            if (motion.has_tips) {
                piece.tips.assign(3, std::vector<double>(n));
                run.tips->read(range.first, piece.tips[0], piece.tips[1], piece.tips[2]);
                for (const std::vector<double>& tips : piece.tips)
                    for (const double value : tips) motion.reach = std::max(motion.reach, std::abs(value));
            }
            row_of_period(motion.parts, run.log->period).pieces.push_back(std::move(piece));
        }
    }
    return motion;
}

/// Differences of an order, each over `stride` records.
std::vector<double> differences(std::vector<double> values, int order, std::size_t stride, double period) {
    const double per_time = 1 / (static_cast<double>(stride) * period);
    for (int k = 0; k < order; ++k) {
        if (values.size() <= stride) return {};
        for (std::size_t i = 0; i + stride < values.size(); ++i)
            values[i] = (values[i + stride] - values[i]) * per_time;
        values.resize(values.size() - stride);
    }
    return values;
}

/// Sets the values of the path to 0 if it bends within the records of a difference: a change of speed along chords is then
/// not one along the path.
void drop_bends(const std::vector<std::vector<double>>& velocities, std::span<const double> speeds, std::size_t reach,
                std::vector<double>& values) {
    constexpr double straight = 1e-6;  // 1 − cos of the angle
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t k = i + reach;
        double dot = 0;
        for (const std::vector<double>& velocity : velocities) dot += velocity[i] * velocity[k];
        if (speeds[i] * speeds[k] - dot > straight * speeds[i] * speeds[k]) values[i] = 0;
    }
}

/// All quantities of an order: one per axis, then one for the path: its speed or the change of the speed.
struct Quantities {
    std::vector<std::vector<double>> values;
    std::vector<double> speeds;
    std::vector<char> rapid;
};

Quantities quantities_of(const MotionPiece& piece, const Motion& motion, double period, int order, std::size_t stride) {
    Quantities made;
    std::vector<std::vector<double>> velocities;
    for (const std::vector<double>& positions : piece.positions)
        made.values.push_back(differences(positions, order, stride, period));
    const std::span<const std::vector<double>> along =
        motion.has_tips ? std::span(piece.tips) : std::span(piece.positions).first(motion.linear());
    for (const std::vector<double>& positions : along) velocities.push_back(differences(positions, 1, stride, period));
    made.speeds.resize(velocities.front().size());
    for (std::size_t i = 0; i < made.speeds.size(); ++i) {
        double square = 0;
        for (const std::vector<double>& velocity : velocities) square += velocity[i] * velocity[i];
        made.speeds[i] = std::sqrt(square);
    }
    made.values.push_back(differences(made.speeds, order - 1, stride, period));
    drop_bends(velocities, made.speeds, static_cast<std::size_t>(order - 1) * stride, made.values.back());
    made.rapid.assign(piece.rapid.begin(),
                      piece.rapid.begin() + static_cast<std::ptrdiff_t>(made.values.front().size()));
    return made;
}

/// Name of an order of differences, and its members in a machine.
struct LimitKind {
    const char* name;
    int order;
    PointIndex least;  ///< fewest records of a plateau
    const char* unit;  ///< after mm or deg
    double factor;     ///< of the reported unit
    double margin;     ///< least standard error, share of the value
    double MachineAxis::*of_axis;
    double PathLimits::*of_path;
};

constexpr LimitKind kind_of(LimitedQuantity of_axis, LimitedQuantity of_path, PointIndex least, const char* unit,
                            double margin) {
    const LimitTableRow& axis = row_of(of_axis);
    return {axis.key.data(),      axis.order, least,        unit,
            axis.unit.per_inside, margin,     axis.of_axis, row_of(of_path).of_path};
}

constexpr std::array limit_kinds{
    kind_of(LimitedQuantity::speed, LimitedQuantity::path_speed, 10, "/min", 1e-4),
    kind_of(LimitedQuantity::acceleration, LimitedQuantity::tangential_acceleration, 5, "/s²", 5e-4),
    kind_of(LimitedQuantity::jerk, LimitedQuantity::path_jerk, 5, "/s³", 5e-3),
};

/// Raises the greatest absolute value of each quantity to that of a part.
void raise_greatest(const Motion& motion, const PeriodMotion& part, int order, std::size_t stride,
                    std::vector<double>& greatest) {
    for (const MotionPiece& piece : part.pieces) {
        if (piece.rapid.size() <= static_cast<std::size_t>(order) * stride) continue;
        const Quantities quantities = quantities_of(piece, motion, part.period, order, stride);
        for (std::size_t q = 0; q < greatest.size(); ++q) {
            for (const double value : quantities.values[q]) greatest[q] = std::max(greatest[q], std::abs(value));
        }
    }
}

/// The greatest error of a difference if positions are rounded to `step`: 2^order half steps.
double error_of(double step, double time, int order) { return std::pow(2.0, order - 1) * step / std::pow(time, order); }

/// The shortest differences whose rounding error is below a percent.
std::size_t stride_of(const Motion& motion, const PeriodMotion& part, int order) {
    constexpr double exact = 0.01;
    std::size_t stride = 1;
    const auto is_exact = [&] {
        std::vector<double> greatest(motion.quantities(), 0.0);
        raise_greatest(motion, part, order, stride, greatest);
        return error_of(motion.rounding, static_cast<double>(stride) * part.period, order) <= exact * greatest.back();
    };
    while (stride < 12 && !is_exact()) ++stride;
    return stride;
}

/// The evidence for a limit.
enum class Evidence : std::uint8_t {
    lower_bound,  ///< the motion stays below it, or another limit explains its greatest values
    shared,       ///< reached, but only where the limits of the path and of an axis have the same effect
    reached,
};

/// The highest levels of all quantities of one order.
class LimitSearch {
public:
    LimitSearch(const Motion& motion, const LimitKind& kind) : motion_(motion), kind_(kind) {
        greatest_.assign(motion.quantities(), 0.0);
        std::vector<std::size_t> strides;
        for (const PeriodMotion& part : motion.parts) {
            strides.push_back(stride_of(motion, part, kind.order));
            const double time = static_cast<double>(strides.back()) * part.period;
            shortest_time_ = std::min(shortest_time_, time);
            longest_time_ = std::max(longest_time_, time);
            raise_greatest(motion, part, kind.order, strides.back(), greatest_);
        }
        for (std::size_t q = 0; q < motion.quantities(); ++q)
            rounding_.push_back(error_of(motion.resolution_along(q), shortest_time_, kind.order));
        std::vector<PlateauFinder> finders;
        for (const double greatest : greatest_)
            finders.emplace_back(error_of(motion.rounding, shortest_time_, kind.order), kind.least, greatest,
                                 kind.order == 2);
        for (std::size_t k = 0; k < motion.parts.size(); ++k) add_plateaus(motion.parts[k], strides[k], finders);
        for (const PlateauFinder& finder : finders) {
            levels_.push_back(finder.highest(least_places, kind.order > 1));
            bounds_.push_back(std::max(finder.nearly_greatest(), finder.held()));
        }
    }

    void report(Identification& result) const {
        bool any_axis = false;
        for (std::size_t q = 0; q < motion_.letters.size(); ++q) {
            const bool alone = is_own_limit(q);
            any_axis |= alone;
            report_axis(q, alone, result);
        }
        if (motion_.linear() < motion_.letters.size() && !motion_.has_tips) {
            result.unidentified.push_back(
                {kind_.name, "path",
                 "with rotary axes the path of the linear axes is not that of the tool (--machine)"});
            return;
        }
        Evidence path = is_own_limit(path_number()) ? Evidence::reached : Evidence::lower_bound;
        if (path == Evidence::lower_bound && levels_.back() && !any_axis) path = Evidence::shared;
        put("path", "mm", path_number(), path, result.machine.path.*kind_.of_path, 1, result);
    }

private:
    void add_plateaus(const PeriodMotion& part, std::size_t stride, std::vector<PlateauFinder>& finders) const {
        for (const MotionPiece& piece : part.pieces) {
            if (piece.rapid.size() <= static_cast<std::size_t>(kind_.order) * stride) continue;
            const Quantities quantities = quantities_of(piece, motion_, part.period, kind_.order, stride);
            const std::span<const char> allowed =
                kind_.order == 1 ? std::span<const char>(quantities.rapid) : std::span<const char>();
            for (std::size_t q = 0; q < finders.size(); ++q)
                finders[q].add(quantities.values, q, quantities.speeds, allowed);
        }
    }

    [[nodiscard]] std::size_t path_number() const { return motion_.letters.size(); }
    /// Whether a quantity is at its greatest value in a plateau.
    [[nodiscard]] bool at_limit(const Plateau& plateau, std::size_t q) const {
        constexpr double alike = 0.005;
        return plateau.at_middle[q] > (1 - alike) * (levels_[q] ? levels_[q]->value : greatest_[q]) &&
               plateau.at_middle[q] > 0;
    }

    /// Whether the quantity is at its level in places where no other limit explains it. On a path parallel to an axis, the
    /// limit of the path explains the motion of the axis, and vice versa.
    [[nodiscard]] bool is_own_limit(std::size_t q) const {
        if (!levels_[q]) return false;
        std::size_t alone = 0;
        double least_share = INFINITY, greatest_share = 0;
        for (const Plateau& plateau : levels_[q]->plateaus) {
            bool explained = false;
            for (std::size_t other = 0; other < greatest_.size(); ++other)
                explained |= other != q && at_limit(plateau, other);
            if (explained) continue;
            ++alone;
            const double path = plateau.at_middle[path_number()];
            const double share = path > 0 ? plateau.level / path : 1;
            least_share = std::min(least_share, share);
            greatest_share = std::max(greatest_share, share);
        }
        // All in one direction that is not parallel to the axis: a limit of the path may be the reason.
        constexpr double same_direction = 0.02;
        return alone >= 2 && (greatest_share >= parallel || greatest_share - least_share > same_direction);
    }

    void report_axis(std::size_t q, bool reached, Identification& result) const {
        MachineAxis none;
        MachineAxis* axis = result.machine.axis(motion_.letters[q]);
        const bool rotary = motion_.letters[q] < 'x';
        MachineAxis& target = axis != nullptr ? *axis : none;
        put({motion_.letters[q]}, rotary ? "deg" : "mm", q, reached ? Evidence::reached : Evidence::lower_bound,
            target.*kind_.of_axis, rotary ? rad_per_deg : 1, result);
    }

    void put(const std::string& of, const std::string& unit, std::size_t q, Evidence evidence, double& target,
             double to_machine, Identification& result) const {
        IdentifiedParameter p{kind_.name, of, 0, unit + kind_.unit, std::nullopt, evidence == Evidence::reached, ""};
        if (is_rounding(q) || (kind_.order == 3 && result.find_missing("max_acceleration", of) != nullptr)) {
            const bool moves = kind_.order > 1 && result.find_missing("max_speed", of) == nullptr;
            const bool speed_changes =
                moves && kind_.order > 2 && result.find_missing("max_acceleration", of) == nullptr;
            result.unidentified.push_back({kind_.name, of,
                                           speed_changes ? "hidden by the rounding of the positions"
                                           : moves       ? "constant speed throughout"
                                                         : "no such motion"});
            return;
        }
        if (evidence == Evidence::reached) {
            // A planner fits ramps to whole periods and stays slightly below its limits.
            const double margin = kind_.margin * levels_[q]->value;
            const double error = std::max(levels_[q]->standard_error, margin) * kind_.factor;
            p.value = rounded_to(levels_[q]->value * kind_.factor, error);
            p.standard_error = error;
            p.note = fmt::format("the motion stays at it in {} places", levels_[q]->plateaus.size());
            target = p.value / kind_.factor * to_machine;
        } else if (kind_.order == 3 && reverses_at_once(of, q, result)) {
            // The path's jerk limit must be a number; this one has no effect.
            target = q == path_number() ? 1e8 : 0;
            p.value = target;
            p.reached.reset();
            p.note = "no limit seen: the acceleration changes between its limits from one record to the next";
        } else {
            p.value = lower_bound(q);
            p.shown = rounded_to(bounds_[q] * kind_.factor, 1e-3 * bounds_[q] * kind_.factor);
            const bool unlimited = target == 0, shared = evidence == Evidence::shared;
            if (shared)
                target = levels_[q]->value * to_machine;
            else if (!unlimited && target < bounds_[q] * to_machine)
                target = p.shown / kind_.factor * to_machine;
            const std::string evident =
                shared ? fmt::format("the path or an axis stays at it in {} places", levels_[q]->plateaus.size())
                       : "hardly exceeded";
            p.note = fmt::format("{}; the file has {:.6g}", evident, target * kind_.factor / to_machine);
        }
        result.parameters.push_back(std::move(p));
    }

    /// The lower bound that the motion gives for an unknown limit [reported unit], reduced by the rounding of positions and of
    /// the result.
    [[nodiscard]] double lower_bound(std::size_t q) const {
        constexpr double part = 1e-3;
        const double rounding = std::max(rounding_[q], error_of(motion_.rounding, shortest_time_, kind_.order));
        const double shown = std::max(0.0, bounds_[q] - rounding) * kind_.factor;
        return rounded_to(shown * (1 - part), part * shown);
    }

    /// Whether rounding alone explains the greatest value.
    [[nodiscard]] bool is_rounding(std::size_t q) const {
        constexpr double several = 4;  // steps of rounding that add up
        const auto moves = [&](const PeriodMotion& part) { return greatest_[q] * part.period >= 1e-9; };
        return std::none_of(motion_.parts.begin(), motion_.parts.end(), moves) ||
               greatest_[q] <= several * rounding_[q];
    }

    /// Whether the acceleration reaches its limit within the time of a difference.
    [[nodiscard]] bool reverses_at_once(const std::string& of, std::size_t q, const Identification& result) const {
        constexpr double acceleration_share = 0.6;
        const IdentifiedParameter* acceleration = result.find("max_acceleration", of);
        return acceleration != nullptr && greatest_[q] * longest_time_ > acceleration_share * acceleration->value;
    }

    const Motion& motion_;
    const LimitKind& kind_;
    double shortest_time_ = INFINITY, longest_time_ = 0;  ///< of a difference [s]
    std::vector<double> rounding_;                        ///< greatest error of a value from rounded positions
    std::vector<double> greatest_, bounds_;
    std::vector<std::optional<PlateauFinder::Level>> levels_;
};

}  // namespace

void identify_limits(std::span<const IdentifyRun> runs, Identification& result) {
    const Motion motion = gather_motion(runs);
    if (motion.letters.empty() || motion.linear() == 0 || motion.parts.empty()) {
        result.unidentified.push_back({"max_speed, max_acceleration, max_jerk", "path", "no commanded positions"});
        return;
    }
    for (const LimitKind& kind : limit_kinds) LimitSearch(motion, kind).report(result);
}

}  // namespace clsurf
