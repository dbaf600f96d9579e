#include "repair/points/end_points.h"

#include <algorithm>
#include <cmath>

#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

/// The ends of motions beyond `first`, an end of a pass, whose lines continue the pass for less than a step-over. `step`: 1
/// towards the end of the program, −1 towards its beginning; `inward`: from `first` into the pass.
std::vector<PointIndex> ends_beyond(const ProgrammedSurface& programmed, PointIndex first, PointIndex step,
                                    const Eigen::Vector3f& inward) {
    const Positions& positions = programmed.surface.positions;
    const double least_cosine = std::cos(least_corner_angle);
    std::vector<PointIndex> ends;
    for (PointIndex point = first, end = first;; point = end) {
        do end += step;
        while (end >= 0 && end < positions.size() && !programmed.ends_motion(end));
        if (end < 0 || end == positions.size()) return ends;
        const Eigen::Vector3f line = positions[point] - positions[end];
        if ((positions[first] - positions[end]).norm() >= programmed.surface.step_over ||
            line.dot(inward) < least_cosine * line.norm() * inward.norm())
            return ends;
        ends.push_back(end);
    }
}

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
    const std::vector<PointIndex> before = ends_beyond(programmed, pass.points.first, -1, forward),
                                  after = ends_beyond(programmed, pass.points.last, 1, backward);
    if (!before.empty() && !programmed.ends_motion(pass.points.first)) pass.ends.erase(pass.ends.begin());
    pass.ends.insert(pass.ends.begin(), before.rbegin(), before.rend());
    pass.ends.insert(pass.ends.end(), after.begin(), after.end());
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
