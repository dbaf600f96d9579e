#include "intervals/program_intervals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/plan/scurve.h"
#include "surface/path_location.h"
#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

constexpr double alike = 0.15;  ///< speeds side by side that differ by less (a share) become one

class IntervalPlanner {
public:
    IntervalPlanner(const Program& program, const ProgrammedSurface& programmed, const IntervalRules& rules,
                    const Machine& machine)
        : motions_(program.motions),
          path_(program.motions, Vec3::Zero()),
          programmed_(programmed),
          rules_(rules),
          machine_(machine),
          of_point_(programmed.motion.size(), none) {
        result_.step_over = programmed.surface.step_over;
        result_.speed_of_motion.assign(static_cast<std::size_t>(motions_.size()),
                                       std::numeric_limits<float>::quiet_NaN());
    }

    ProgramIntervals run() {
        for (const ProgrammedPass& pass : cut_passes(programmed_)) divide_pass(pass);
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

    void divide_pass(const ProgrammedPass& pass) {
        ++result_.passes;
        std::vector<Vec3> points;
        std::vector<PointIndex> ends;
        for (const PointIndex end : pass.ends) {
            const Vec3 p = programmed_.ends_motion(end) ? path_.end(programmed_.motion_of(end))
                                                        : programmed_.surface.positions.absolute(end);
            if (!points.empty() && p == points.back()) continue;
            points.push_back(p);
            ends.push_back(end);
        }
        add_beginning(pass, points, ends);
        const std::size_t first = result_.intervals.size();
        for (const SpeedInterval& piece : divide(points, rules_)) {
            ProgramInterval interval;
            interval.pass = pass.number;
            interval.first_line = motions_.line[programmed_.motion_of(ends[piece.first + 1])];
            interval.last_line = motions_.line[programmed_.motion_of(ends[piece.last])];
            interval.mean_curvature = piece.mean_curvature;
            interval.greatest_curvature = piece.greatest_curvature;
            interval.feed = std::numeric_limits<double>::infinity();
            for (std::size_t k = piece.first + 1; k <= piece.last; ++k) {
                interval.length += (points[k] - points[k - 1]).norm();
                interval.feed =
                    std::min(interval.feed, static_cast<double>(motions_.feed[programmed_.motion_of(ends[k])]));
            }
            for (PointIndex i = ends[piece.first] + 1; i <= ends[piece.last]; ++i)
                of_point_[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(result_.intervals.size());
            const double most = std::min(interval.feed * machine_.controller.feed_override, machine_.path.max_speed);
            interval.own_speed = interval.speed = planned_speed(piece, most, speed_limits_of(machine_));
            result_.intervals.push_back(interval);
        }
        for (std::size_t k = first + 1; k + 1 < result_.intervals.size(); ++k) {
            ProgramInterval& here = result_.intervals[k];
            const double before = result_.intervals[k - 1].speed, after = result_.intervals[k + 1].speed;
            if (here.speed > std::max(before, after) &&
                ramp(before, here.speed) + ramp(here.speed, after) > here.length)
                here.speed = std::max(before, after);
        }
    }

    /// A pass begins where its first motion ends, or inside it: that motion belongs to it from its own beginning on, unless
    /// it comes from elsewhere (a plunge).
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
                const PathLocation at = beside(programmed_.surface, {i, 0}, feed, side);
                if (!at.exists() || of_point_[static_cast<std::size_t>(at.nearest())] == none) continue;
                double &a = result_.intervals[mine].speed,
                       &b = result_.intervals[of_point_[static_cast<std::size_t>(at.nearest())]].speed;
                if (std::max(a, b) < (1 + alike) * std::min(a, b)) a = b = std::min(a, b);
            }
        };
        for (PointIndex i = 0; i < count; ++i) match(i);
        for (PointIndex i = count; i-- > 0;) match(i);
    }

    const Motions& motions_;
    Toolpath path_;
    const ProgrammedSurface& programmed_;
    const IntervalRules& rules_;
    const Machine& machine_;
    std::vector<std::uint32_t> of_point_;  ///< index of its interval
    ProgramIntervals result_;
};

}  // namespace

ProgramIntervals plan_intervals(const Program& program, const ProgrammedSurface& programmed, const IntervalRules& rules,
                                const Machine& machine) {
    return IntervalPlanner(program, programmed, rules, machine).run();
}

}  // namespace clsurf
