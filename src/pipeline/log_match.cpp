#include "pipeline/log_match.h"

#include <fmt/format.h>

#include "mapping/line_agreement.h"
#include "mapping/line_map.h"
#include "mapping/map_lines.h"
#include "pipeline/placement.h"
#include "pipeline/roles.h"
#include "pipeline/state_tool_axes.h"
#include "toolpath/tip_motions.h"

namespace clsurf {

ProgramMatch match_log(Program program, const Log& log, const FramePoses& given,
                       const std::shared_ptr<const Kinematics>& kinematics, ProgramIdentity identity,
                       Diagnostics& diagnostics) {
    const Role role = shown_role(log);
    if (!log.has(role) || log.records == 0 || program.motions.size() == 0) return {};
    const Eigen::Isometry3d pose = place_with(program, log, given, kinematics.get(), diagnostics);
    const Trajectory path = reconstruct(log, role, pose, kinematics);
    if (kinematics) {
        program.diagnostics = {};
        solve_tool_axes(program, *kinematics, {}, {}, pose.linear());
        diagnostics.append(program.diagnostics);
        make_tip_motions(program, *kinematics, pose, start_of(log, *kinematics, pose));
    } else {
        note_rotary(log, role, diagnostics);
    }
    if (!kinematics && diagnostics.count("path.rotary") == 0) note_unknown_axis(program, diagnostics);
    const LineMap lines = map_lines(path, log, program, true, diagnostics, identity);
    const LineAgreement a = check_lines(path, program, lines);
    if (a.checked == 0) return lines.match();
    diagnostics.add(
        {Severity::note,
         "map.distance",
         Place::of_file(log.name),
         fmt::format("positions deviate by {:.4f} mm (median) and {:.4f} mm (95th percentile) from the lines of {}",
                     a.median_distance, a.p95_distance, program.main().name()),
         {}});
    return lines.match();
}

}  // namespace clsurf
