#include "pipeline/state_tool_axes.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "core/block.h"
#include "toolpath/stated_axes.h"
#include "toolpath/tool_axes.h"

namespace clsurf {
namespace {

void note_unknown_axis(const Program& program, const StatedAxes& stated, Diagnostics& diagnostics) {
    const auto at = static_cast<std::size_t>(*stated.unknown);
    const Motions& motions = program.motions;
    const std::string& file = program.files[motions.file.empty() ? 0 : motions.file[at]].name();
    diagnostics.add({Severity::warning, "path.tool-axis", Place::of_line(file, motions.line[at]),
                     "rotary axes turn the tool or the part: without the machine's kinematics there are no contact "
                     "points, no as-machined surface and no roughness",
                     "give the kinematics with --machine FILE"});
}

/// The axis of each point, from that of its motion.
ToolAxes axes_of_points(const Column<Xyz>& of_motion, const LineMap& lines) {
    auto columns = std::make_shared<ToolAxes::Columns>();
    for (Column<double>& column : *columns) column.resize(static_cast<std::size_t>(lines.count()));
    Vec3 axis = Vec3::UnitZ();
    std::vector<LineNumber> line;
    for (PointIndex begin = 0; begin < lines.count(); begin += block_points) {
        line.resize(static_cast<std::size_t>(std::min(block_points, lines.count() - begin)));
        lines.read(begin, line);
        for (std::size_t i = 0; i < line.size(); ++i) {
            const PointIndex point = begin + static_cast<PointIndex>(i);
            if (const std::int64_t motion = lines.motion_at(point, line[i]); motion >= 0)
                axis = of_motion[static_cast<std::size_t>(motion)].vec();
            for (std::size_t k = 0; k < 3; ++k)
                columns->at(k)[static_cast<std::size_t>(point)] = axis[static_cast<Eigen::Index>(k)];
        }
    }
    return ToolAxes(std::move(columns));
}

}  // namespace

void state_tool_axes(Trajectory& path, const Program& program, const LineMap& lines, Diagnostics& diagnostics) {
    if (path.kinematics != nullptr) return;
    path.axis_known = diagnostics.count("path.rotary") == 0;
    if (!path.axis_known) return;
    const StatedAxes stated = stated_axes(program.motions);
    if (stated.unknown) {
        path.axis_known = false;
        note_unknown_axis(program, stated, diagnostics);
    } else if (!stated.axis.empty()) {
        path.stated_axes = std::make_shared<const ToolAxes>(axes_of_points(stated.axis, lines));
    }
}

void note_unknown_axis(const Program& program, Diagnostics& diagnostics) {
    const StatedAxes stated = stated_axes(program.motions);
    if (stated.unknown) note_unknown_axis(program, stated, diagnostics);
}

}  // namespace clsurf
