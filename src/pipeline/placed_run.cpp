#include "pipeline/placed_run.h"

#include <utility>

#include "core/error.h"
#include "mapping/map_lines.h"
#include "pipeline/placement.h"
#include "pipeline/roles.h"
#include "pipeline/simulated_log.h"
#include "pipeline/state_tool_axes.h"

namespace clsurf {
namespace {

/// Without a pose all positions stay in machine coordinates.
Coordinates coordinates_of(const FramePoses& poses, const Log& log) {
    return poses.zero || log.work_offset ? Coordinates::workpiece : Coordinates::machine;
}

void require_records(const PlacedRun& run) {
    if (run.log.records == 0) throw InputError(Place::of_file(run.name), "contains no records");
}

}  // namespace

Trajectory PlacedRun::positions(Role role) const {
    return path ? reconstruct_like(log, role, *path) : reconstruct(log, role, pose, kinematics);
}

PlacedRun placed_run(std::string name, Log log, const PlacingRules& rules) {
    PlacedRun run;
    run.name = std::move(name);
    run.log = std::move(log);
    run.kinematics = rules.kinematics;
    run.pose = zero_of(rules.poses, run.log, run.log.diagnostics).value_or(Eigen::Isometry3d::Identity());
    run.derivative = rules.derivative;
    if (!run.kinematics) note_rotary(run.log, shown_role(run.log), run.log.diagnostics);
    require_records(run);
    return run;
}

PlacedRun placed_run(const Part& part) {
    PlacedRun run;
    run.name = part.log.name;
    run.log = part.log;
    run.kinematics = part.path.kinematics;
    run.pose = part.path.pose();
    run.derivative = part.derivative;
    run.path = part.path;
    const bool known = part.log.find("line") != nullptr || part.program.motions.size() > 0;
    run.tool = part.tool;
    run.lines = RunLines{part.lines, nullptr, known};  // its path has the tool axes already
    return run;
}

PlacedRun simulate_run(std::string name, Program program, const Machine& machine, const Vec3& start,
                       const PlacingRules& rules) {
    PlacedRun run;
    run.name = std::move(name);
    run.derivative = rules.derivative;
    if (runs_on_five_axes(program, machine)) run.kinematics = rules.kinematics;
    run.pose = prepare_run(program, machine, rules.poses, start, coordinates_of(rules.poses, run.log));
    SimulatedRun made = simulate_to_log(program, machine, start, {}, run.pose.translation());
    run.log = std::move(made.log);
    run.log.name = program.main().name();
    run.log.diagnostics = program.diagnostics;
    run.log.diagnostics.append(made.summary.diagnostics);
    run.simulated = std::make_shared<const Program>(std::move(program));
    require_records(run);
    return run;
}

namespace {

/// A simulated program on five axes has axes along those of the machine, whatever the rotation of the pose.
LineMap lines_on_five_axes(const PlacedRun& run, const Trajectory& path, Diagnostics& diagnostics) {
    Eigen::Isometry3d level = Eigen::Isometry3d::Identity();
    level.translation() = run.pose.translation();
    return map_lines(reconstruct(run.log, path.role, level, run.kinematics), run.log, *run.simulated, true,
                     diagnostics);
}

RunLines lines_of_program(const PlacedRun& run, const Trajectory& path, const PlacingRules& rules,
                          Diagnostics& diagnostics) {
    auto [program, identity] = rules.program_of(run.log);
    if (run.kinematics) {
        FramePoses poses = rules.poses;
        poses.zero = run.pose;
        (void)place_tips_with(program, run.log, poses, run.kinematics.get(), diagnostics);
    } else {
        (void)place_motions(program, {}, coordinates_of(rules.poses, run.log));
    }
    diagnostics.append(program.diagnostics);
    LineMap lines = map_lines(path, run.log, program, true, diagnostics, identity);
    // Without kinematics, the path of the axes does not show whether a log of five axes belongs to the program.
    if (run.kinematics || run.log.diagnostics.count("path.rotary") == 0)
        refuse_foreign(lines.match(), program, run.log, rules.accept_foreign, diagnostics);
    return {std::make_shared<const LineMap>(std::move(lines)), std::make_shared<const Program>(std::move(program)),
            true};
}

}  // namespace

RunLines lines_of(const PlacedRun& run, const Trajectory& path, const PlacingRules& rules, Diagnostics& diagnostics) {
    if (run.lines) return *run.lines;
    if (run.simulated) {
        LineMap map = run.kinematics ? lines_on_five_axes(run, path, diagnostics)
                                     : map_lines(path, run.log, *run.simulated, true, diagnostics);
        return {std::make_shared<const LineMap>(std::move(map)), run.simulated, true};
    }
    if (rules.program_of) return lines_of_program(run, path, rules, diagnostics);
    return {std::make_shared<const LineMap>(lines_without_program(run.log, path.count)), nullptr,
            run.log.find("line") != nullptr};
}

void state_tool_axes(Trajectory& path, const PlacedRun& run, const RunLines& lines, Diagnostics* diagnostics) {
    if (!lines.program) return;
    Diagnostics of_log = run.log.diagnostics;
    state_tool_axes(path, *lines.program, *lines.map, of_log);
    if (diagnostics != nullptr && of_log.count("path.tool-axis") > 0) note_unknown_axis(*lines.program, *diagnostics);
}

}  // namespace clsurf
