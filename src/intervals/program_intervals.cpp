#include "intervals/program_intervals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "intervals/shared_boundaries.h"
#include "program/coordinate_step.h"
#include "simulation/plan/scurve.h"
#include "surface/path_location.h"
#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

constexpr double shared_reach = 2;  ///< scatter of boundaries of adjacent passes along the path, in step-overs
// As in docs/optimize.md#intervals, points 5 and 7.
constexpr double alike = 0.15;  ///< adjacent speeds that differ by less (relative) become one

bool are_alike(double a, double b) { return std::max(a, b) < (1 + alike) * std::min(a, b); }

/// A cut pass without repeated points.
struct PassPoints {
    std::vector<Vec3> points;
    std::vector<double> curvature;
};

class IntervalPlanner {
public:
    IntervalPlanner(const Program& program, const ProgrammedSurface& programmed, const IntervalRules& rules,
                    const Machine& machine)
        : motions_(program.motions),
          path_(program.motions, Vec3::Zero()),
          programmed_(programmed),
          rules_(rules),
          machine_(machine),
          limits_(speed_limits_of(machine)),
          of_point_(programmed.motion.size(), none) {
        rules_.coordinate_step = coordinate_step(program.motions);
        result_.step_over = programmed.surface.step_over;
        result_.speed_of_motion.assign(static_cast<std::size_t>(motions_.size()),
                                       std::numeric_limits<float>::quiet_NaN());
    }

    ProgramIntervals run() {
        passes_ = cut_passes(programmed_);
        result_.passes = static_cast<std::int64_t>(passes_.size());
        PassBoundaries boundaries;
        for (ProgrammedPass& pass : passes_) boundaries.push_back(divide_pass(pass));
        share(boundaries);
        for (std::size_t k = 0; k < passes_.size(); ++k) add_intervals(k, boundaries[k]);
        match_neighbours();
        for (std::size_t i = 0; i < of_point_.size(); ++i) {
            if (of_point_[i] != none)
                result_.speed_of_motion[programmed_.motion[i]] =
                    static_cast<float>(result_.intervals[of_point_[i]].speed);
        }
        return std::move(result_);
    }

private:
    static constexpr std::uint32_t none = 0xffffffffU;

    /// The boundaries of one pass; repeated points at its ends are removed.
    std::vector<PointIndex> divide_pass(ProgrammedPass& pass) {
        PassPoints mine;
        std::vector<PointIndex> ends;
        for (const PointIndex end : pass.ends) {
            const Vec3 p = programmed_.ends_motion(end) ? path_.end(programmed_.motion_of(end))
                                                        : programmed_.surface.positions.absolute(end);
            if (!mine.points.empty() && p == mine.points.back()) continue;
            mine.points.push_back(p);
            ends.push_back(end);
        }
        add_beginning(pass, mine.points, ends);
        pass.ends = std::move(ends);
        mine.curvature = curvatures(mine.points, rules_);
        std::vector<PointIndex> boundaries;
        for (const std::size_t b : all_boundaries(mine.points, mine.curvature, rules_))
            boundaries.push_back(pass.ends[b]);
        add_changes_of_feed(pass.ends, boundaries);
        points_.push_back(std::move(mine));
        return boundaries;
    }

    [[nodiscard]] double programmed_feed(PointIndex end) const {
        return static_cast<double>(motions_.feed[programmed_.motion_of(end)]);
    }

    /// Adds changes of feed, so that a few lines with a lower feed do not slow the whole interval down.
    void add_changes_of_feed(const std::vector<PointIndex>& ends, std::vector<PointIndex>& boundaries) const {
        for (std::size_t i = 1; i + 1 < ends.size(); ++i) {
            if (!are_alike(programmed_feed(ends[i]), programmed_feed(ends[i + 1]))) boundaries.push_back(ends[i]);
        }
        std::sort(boundaries.begin(), boundaries.end());
        boundaries.erase(std::unique(boundaries.begin(), boundaries.end()), boundaries.end());
    }

    /// Aligns boundaries with those of the adjacent passes. Removes boundaries that no other pass has and that separate
    /// equal speeds.
    void share(PassBoundaries& boundaries) const {
        if (!(programmed_.surface.step_over > 0)) return;
        const double reach = shared_reach * programmed_.surface.step_over;
        boundaries = share_boundaries(programmed_, passes_, boundaries, reach);
        const AdjacentBoundaries adjacent(programmed_, boundaries, reach);
        PassBoundaries kept(boundaries.size());
        for (std::size_t k = 0; k < boundaries.size(); ++k) {
            const std::vector<SpeedInterval> intervals = intervals_of(k, boundaries[k]);
            for (std::size_t b = 0; b < boundaries[k].size(); ++b) {
                const bool inside = b > 0 && b < intervals.size();
                if (inside && alike_across(k, intervals[b - 1], intervals[b])) {
                    const AdjacentBoundaries::Places places = adjacent.around(boundaries[k][b]);
                    if (places.passes > 1 && places.offsets.empty()) continue;
                }
                kept[k].push_back(boundaries[k][b]);
            }
        }
        boundaries = std::move(kept);
    }

    /// Whether two consecutive intervals can be run at one speed.
    [[nodiscard]] bool alike_across(std::size_t k, const SpeedInterval& before, const SpeedInterval& after) const {
        if (!std::isfinite(points_[k].curvature[before.last])) return false;  // reversal
        return are_alike(planned_speed(before, machine_.path.max_speed, limits_),
                         planned_speed(after, machine_.path.max_speed, limits_)) &&
               are_alike(lowest_feed(k, before), lowest_feed(k, after));
    }

    [[nodiscard]] double lowest_feed(std::size_t k, const SpeedInterval& interval) const {
        double lowest = std::numeric_limits<double>::infinity();
        for (std::size_t i = interval.first + 1; i <= interval.last; ++i)
            lowest = std::min(lowest, programmed_feed(passes_[k].ends[i]));
        return lowest;
    }

    [[nodiscard]] std::vector<SpeedInterval> intervals_of(std::size_t k,
                                                          const std::vector<PointIndex>& boundaries) const {
        const std::vector<PointIndex>& ends = passes_[k].ends;
        std::vector<std::size_t> indices;
        for (const PointIndex b : boundaries)
            indices.push_back(static_cast<std::size_t>(std::lower_bound(ends.begin(), ends.end(), b) - ends.begin()));
        return intervals_between(points_[k].points, points_[k].curvature, indices);
    }

    void add_intervals(std::size_t k, const std::vector<PointIndex>& boundaries) {
        const std::vector<PointIndex>& ends = passes_[k].ends;
        const std::vector<Vec3>& points = points_[k].points;
        const std::size_t first = result_.intervals.size();
        for (const SpeedInterval& piece : intervals_of(k, boundaries)) {
            ProgramInterval interval;
            interval.pass = passes_[k].number;
            interval.first_line = motions_.line[programmed_.motion_of(ends[piece.first + 1])];
            interval.last_line = motions_.line[programmed_.motion_of(ends[piece.last])];
            interval.mean_curvature = piece.mean_curvature;
            interval.greatest_curvature = piece.greatest_curvature;
            interval.feed = lowest_feed(k, piece);
            for (std::size_t i = piece.first + 1; i <= piece.last; ++i)
                interval.length += (points[i] - points[i - 1]).norm();
            for (PointIndex i = ends[piece.first] + 1; i <= ends[piece.last]; ++i)
                of_point_[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(result_.intervals.size());
            const double most = std::min(interval.feed * machine_.controller.feed_override, machine_.path.max_speed);
            interval.own_speed = interval.speed = planned_speed(piece, most, limits_);
            result_.intervals.push_back(interval);
        }
        slow_short_intervals(first);
    }

    /// Intervals that are too short for a change of speed keep the higher speed of both sides.
    void slow_short_intervals(std::size_t first) {
        for (std::size_t k = first + 1; k + 1 < result_.intervals.size(); ++k) {
            ProgramInterval& here = result_.intervals[k];
            const double before = result_.intervals[k - 1].speed, after = result_.intervals[k + 1].speed;
            if (here.speed > std::max(before, after) &&
                ramp(before, here.speed) + ramp(here.speed, after) > here.length)
                here.speed = std::max(before, after);
        }
    }

    /// A pass begins at the end of its first motion, or within it. That motion belongs to the pass from its own start on,
    /// unless it comes from elsewhere (a plunge).
    void add_beginning(const ProgrammedPass& pass, std::vector<Vec3>& points, std::vector<PointIndex>& ends) const {
        constexpr double straight_on = 0.7;  // cosine
        const std::uint32_t motion = programmed_.motion_of(pass.ends.front());
        const MotionKind kind = motions_.kind[motion];
        if (motion == 0 || points.size() < 2 || kind == MotionKind::rapid || kind == MotionKind::dwell) return;
        const Vec3 start = path_.end(motion - 1);
        const Vec3 before = points[0] - start, after = points[1] - points[0];
        if (!(before.norm() > 0) || !(before.dot(after) > straight_on * before.norm() * after.norm())) return;
        const PointIndex front = pass.points.first - 1;
        if (!programmed_.ends_motion(pass.ends.front())) {
            points.front() = start;
            ends.front() = front;
            return;
        }
        points.insert(points.begin(), start);
        ends.insert(ends.begin(), front);
    }

    [[nodiscard]] double ramp(double from, double to) const {
        return ramp_distance(from, to, machine_.path.max_acceleration, machine_.path.max_jerk);
    }

    void match_neighbours() {
        const auto count = static_cast<PointIndex>(of_point_.size());
        const auto match = [&](PointIndex i) {
            const std::uint32_t mine = of_point_[static_cast<std::size_t>(i)];
            if (mine == none || i == 0) return;
            const Eigen::Vector3f feed = programmed_.surface.positions[i] - programmed_.surface.positions[i - 1];
            for (const Side side : {Side::left, Side::right}) {
                const PathLocation at = adjacent_location(programmed_.surface, {i, 0}, feed, side);
                if (!at.exists() || of_point_[static_cast<std::size_t>(at.nearest())] == none) continue;
                double &a = result_.intervals[mine].speed,
                       &b = result_.intervals[of_point_[static_cast<std::size_t>(at.nearest())]].speed;
                if (are_alike(a, b)) a = b = std::min(a, b);
            }
        };
        for (PointIndex i = 0; i < count; ++i) match(i);
        for (PointIndex i = count; i-- > 0;) match(i);
    }

    const Motions& motions_;
    Toolpath path_;
    const ProgrammedSurface& programmed_;
    IntervalRules rules_;
    const Machine& machine_;
    SpeedLimits limits_;
    std::vector<ProgrammedPass> passes_;   ///< without repeated points at the ends
    std::vector<PassPoints> points_;       ///< of each pass
    std::vector<std::uint32_t> of_point_;  ///< index of the interval of each point
    ProgramIntervals result_;
};

}  // namespace

ProgramIntervals plan_intervals(const Program& program, const ProgrammedSurface& programmed, const IntervalRules& rules,
                                const Machine& machine) {
    return IntervalPlanner(program, programmed, rules, machine).run();
}

}  // namespace clsurf
