#include "pipeline/tool_run.h"

#include "core/error.h"
#include "surface/stitch.h"

namespace clsurf {

AsMachinedSurface ToolRun::as_machined(const CuttingTool& tool, const QualityReport* report) const {
    return {surface,
            read.signals,
            path.role,
            read.swept(path),
            read.pieces,
            tool,
            report != nullptr ? ProgrammedMarks(surface, read.signals, *report) : ProgrammedMarks()};
}

AsMachinedSurface ToolRun::as_commanded(const CuttingTool& tool) const {
    return {surface, read.signals, path.role, path, read.pieces, tool};
}

std::unique_ptr<const UprightPart> upright_part(const Log& log, const Trajectory& path, const LineMap& lines,
                                                std::optional<Role> wanted, const CuttingTool& tool) {
    if (!path.axis_known) {
        throw UsageError("the axis of " + to_text(tool) + " is not known, and so is the surface that it leaves",
                         "give the kinematics with --machine FILE");
    }
    if (!tilts(log, path)) return nullptr;
    if (tool.kind != ToolKind::ball) {
        throw UsageError(
            to_text(tool) +
                " is tilted: the contact of a tool that is not a ball depends on its axis, and only tools along z are supported",
            "a ball-end tool may be tilted: --tool ball:D");
    }
    auto upright = std::make_unique<UprightPart>();
    upright->path = upright_ball(log, path, tool.radius);
    upright->surface = stitch(gather(upright->path), lines);
    upright->read = signals_along(log, upright->path, upright->surface, wanted);
    return upright;
}

}  // namespace clsurf
