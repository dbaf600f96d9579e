#include "mapping/line_agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "core/statistics.h"
#include "mapping/allowed_motions.h"
#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

// A bound on the time: about 10^5 points.
constexpr PointIndex checked_sections = 64;   ///< evenly spaced over the log
constexpr PointIndex checked_section = 1600;  ///< points
/// A reported line agrees if the point is this near to it [mm]: a corner tolerance of finishing (0.01 mm), with a
/// margin for the two records by which a kernel's line leads its axes.
constexpr double agreeing_distance = 0.05;
constexpr double blending_distance = 1.0;  ///< [mm] G64 without a tolerance

/// Distance of a position from the allowed motions; NaN: there are none.
double allowed_distance(const Toolpath& path, std::int64_t before, std::int64_t motion, const Vec3& position) {
    double best = std::numeric_limits<double>::quiet_NaN();
    if (motion < 0) return best;
    const MotionRange range = allowed_motions(before, motion, path.size());
    for (std::int64_t m = range.first; m <= range.last; ++m) {
        const double distance = path.projection(m, position).distance;
        if (!(best <= distance)) best = distance;
    }
    return best;
}

/// 1 within a finishing tolerance; 0 if there is no motion.
double off_confidence(double distance) {
    if (!(distance == distance)) return 0.0;
    return distance <= agreeing_distance ? 1.0 : agreeing_distance / distance;
}

}  // namespace

double corner_tolerance(const Program& program) {
    double allowed = agreeing_distance;
    for (const ProgramEvent& event : program.events) {
        const PathMode* const mode = event.path_mode();
        if (mode == nullptr || mode->block_end != BlockEnd::rounded) continue;
        // The deviation at a corner, plus that of merged short blocks.
        const double tolerance = mode->tolerance + mode->merging_tolerance;
        if (!std::isnan(tolerance)) allowed = std::max(allowed, std::min(tolerance, blending_distance));
    }
    return allowed;
}

LineAgreement check_lines(const Trajectory& path, const Program& program, const LineMap& map) {
    LineAgreement agreement;
    agreement.tolerance = corner_tolerance(program);
    const Toolpath toolpath(program.motions, path.count > 0 ? path.at(0) : Vec3::Zero());
    const PointIndex section = std::min(path.count, checked_section);
    const PointIndex sections = std::min<PointIndex>(checked_sections, section > 0 ? path.count / section : 0);
    Column<double> distances;
    std::vector<double> x(static_cast<std::size_t>(section)), y(x.size()), z(x.size());
    std::vector<LineNumber> lines(x.size());
    for (PointIndex s = 0; s < sections; ++s) {
        const PointIndex begin = sections == 1 ? 0 : (path.count - section) / (sections - 1) * s;
        path.read(begin, x, y, z);
        map.read(begin, lines);
        std::int64_t earlier = -1, before = -1;
        std::int64_t motion = map.motion_at(begin);
        // The line before the first one of a section is unknown.
        bool known = begin == 0;
        for (std::size_t i = 1; i < x.size(); ++i) {
            const PointIndex point = begin + static_cast<PointIndex>(i);
            if (const std::int64_t now = map.motion_at(point, lines[i]); now != motion) {
                earlier = before;
                before = motion;
                motion = now;
                known = true;
            }
            const Vec3 p(x[i], y[i], z[i]);
            const bool moved = (p - Vec3(x[i - 1], y[i - 1], z[i - 1])).squaredNorm() > 0;
            if (!moved || !known || lines[i] == 0 || map.on_return(point)) continue;
            const double distance = allowed_distance(toolpath, begin_of_merge(earlier, before), motion, p);
            if (!std::isfinite(distance)) continue;
            distances.push_back(distance);
            if (distance > agreement.tolerance) ++agreement.disagreeing;
            if (distance > agreement.worst_distance) {
                agreement.worst_distance = distance;
                agreement.worst = point;
            }
        }
    }
    agreement.checked = static_cast<PointIndex>(distances.size());
    if (distances.empty()) return agreement;
    agreement.median_distance = quantile_below(distances, 0.5);
    agreement.p95_distance = quantile_below(distances, 0.95);
    return agreement;
}

void read_confidences(const Trajectory& path, const Program& program, const LineMap& map, PointIndex begin,
                      std::span<double> out) {
    if (out.empty()) return;
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = map.confidence_at(begin + static_cast<PointIndex>(i));
    if (!map.from_log()) return;
    const Toolpath toolpath(program.motions, path.at(0));
    // If the first point begins a run, the previous line is known.
    std::int64_t motion = map.motion_at(begin);
    PointIndex first = begin;
    while (first > 0 && begin - first < checked_section && map.motion_at(first) == motion) --first;
    std::int64_t before = map.motion_at(first);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const PointIndex point = begin + static_cast<PointIndex>(i);
        if (const std::int64_t now = map.motion_at(point); now != motion) {
            before = motion;
            motion = now;
        }
        if (out[i] > 0) out[i] *= off_confidence(allowed_distance(toolpath, before, motion, path.at(point)));
    }
}

}  // namespace clsurf
