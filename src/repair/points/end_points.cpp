#include "repair/points/end_points.h"

#include <algorithm>

#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

// cos of ResampleRules::corner_angle: beyond it, points do not move.
constexpr double least_cosine = 0.88;

}  // namespace

void fix_end_points(std::vector<AlignedPoint>& aligned_points, double length, bool from_begin, bool to_end,
                    const EndLines& ends) {
    if (!(ends.first > 0) || (!from_begin && !to_end)) return;
    const double gap = 0.5 * ends.step;  // the least between a fixed point and another one
    const double reach = std::min(ends.reach, from_begin && to_end ? 0.5 * (length - gap) : length - gap);
    std::vector<AlignedPoint> fixed;
    for (double distance = ends.first; distance < reach; distance += ends.step)
        fixed.push_back({.arc_length = distance, .part = ends.step, .fixed = true});
    if (fixed.empty()) return;
    const double low = from_begin ? fixed.back().arc_length + gap : 0,
                 high = to_end ? length - fixed.back().arc_length - gap : length;
    std::erase_if(aligned_points, [&](const AlignedPoint& p) { return p.arc_length < low || p.arc_length > high; });
    if (from_begin) aligned_points.insert(aligned_points.begin(), fixed.begin(), fixed.end());
    if (!to_end) return;
    for (auto point = fixed.rbegin(); point != fixed.rend(); ++point) {
        aligned_points.push_back(*point);
        aligned_points.back().arc_length = length - point->arc_length;
    }
}

ProgrammedPass up_to_corners(const ProgrammedSurface& programmed, ProgrammedPass pass) {
    const Positions& positions = programmed.surface.positions;
    const Eigen::Vector3f forward = positions[pass.ends[1]] - positions[pass.ends[0]],
                          backward = positions[pass.ends[pass.ends.size() - 2]] - positions[pass.ends.back()];
    // Whether the line from `point` of the pass on to `end` still belongs to it.
    const auto belongs = [&](PointIndex point, PointIndex end, PointIndex limit, const Eigen::Vector3f& inward) {
        const Eigen::Vector3f line = positions[point] - positions[end];
        return (positions[limit] - positions[end]).norm() < programmed.surface.step_over &&
               line.dot(inward) >= least_cosine * line.norm() * inward.norm();
    };
    for (PointIndex point = pass.points.first, end = point;; point = end) {
        do --end;
        while (end >= 0 && !programmed.ends_motion(end));
        if (end < 0 || !belongs(point, end, pass.points.first, forward)) break;
        if (!programmed.ends_motion(point)) pass.ends.erase(pass.ends.begin());
        pass.ends.insert(pass.ends.begin(), end);
    }
    for (PointIndex point = pass.points.last, end = point;; point = end) {
        do ++end;
        while (end < positions.size() && !programmed.ends_motion(end));
        if (end == positions.size() || !belongs(point, end, pass.points.last, backward)) break;
        pass.ends.push_back(end);
    }
    return pass;
}

void mark_pass_ends(const Program& program, const ProgrammedSurface& programmed, double reach,
                    std::vector<std::uint8_t>& marks) {
    const Toolpath path(program.motions, Vec3::Zero());
    const auto mark = [&](PointIndex end, double& distance) {
        const std::uint32_t motion = programmed.motion_of(end);
        if (distance < reach) marks[motion] = 1;
        distance += path.length(motion);
    };
    for (const ProgrammedPass& inside : cut_passes(programmed)) {
        const ProgrammedPass pass = up_to_corners(programmed, inside);
        double from_begin = 0, to_end = 0;
        for (std::size_t k = 1; k < pass.ends.size(); ++k) {
            mark(pass.ends[k], from_begin);
            mark(pass.ends[pass.ends.size() - k], to_end);
        }
    }
}

}  // namespace clsurf
