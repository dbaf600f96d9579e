#include "lint/contact_places.h"

#include <optional>

#include "core/parallel.h"
#include "machined/contact_points.h"

namespace clsurf {

void add_contacts(LintReport& report, const Program& program, const ProgrammedSurface& programmed,
                  const CuttingTool& tool) {
    if (!program.motions.rotary.empty() || !program.motions.tool_axis.empty()) return;
    const Trajectory path = trajectory_of(programmed.surface.positions);
    const ContactPoints points(programmed.surface, path, std::nullopt, tool);
    parallel_for(static_cast<std::int64_t>(report.findings.size()), 1, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) {
            LintFinding& finding = report.findings[static_cast<std::size_t>(k)];
            finding.place.contact = points.at(finding.point);
        }
    });
}

}  // namespace clsurf
