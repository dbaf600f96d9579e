#include "limits/line_lead.h"

#include <algorithm>
#include <array>
#include <vector>

#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

// A bound on the time: about 10^5 records.
constexpr PointIndex section_count = 64, section_length = 1600;  // records
constexpr double most_off = 0.5;                                 ///< [mm] a greater distance is not caused by a lead

}  // namespace

PointIndex find_line_lead(const Trajectory& path, const Program& program, const LineMap& lines) {
    if (!lines.from_log() || path.count <= longest_line_lead || program.motions.size() == 0) return 0;
    const Toolpath toolpath(program.motions, path.at(0));
    std::array<double, longest_line_lead + 1> off{};
    const PointIndex step = std::max<PointIndex>(section_length, path.count / section_count);
    for (PointIndex first = longest_line_lead; first < path.count; first += step) {
        const PointIndex end = std::min(path.count, first + section_length);
        for (PointIndex point = first; point < end; ++point) {
            // Leads have different results only where the line changes.
            const std::int64_t now = lines.motion_at(point);
            const std::int64_t then = lines.motion_at(point - longest_line_lead);
            if (now == then || now < 0 || then < 0) continue;
            const Vec3 position = path.at(point);
            for (PointIndex lead = 0; lead <= longest_line_lead; ++lead) {
                const std::int64_t motion = lines.motion_at(point - lead);
                const double distance = motion < 0 ? most_off : toolpath.projection(motion, position).distance;
                off[static_cast<std::size_t>(lead)] += std::min(most_off, distance);
            }
        }
    }
    return std::min_element(off.begin(), off.end()) - off.begin();
}

}  // namespace clsurf
