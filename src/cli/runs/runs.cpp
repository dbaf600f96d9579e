#include "cli/runs/runs.h"

#include <utility>

#include "cli/options/part.h"
#include "io/files/compressed.h"
#include "io/formats/program_identity.h"
#include "io/readers/program_file.h"
#include "mapping/map_lines.h"
#include "pipeline/placement.h"
#include "pipeline/roles.h"
#include "pipeline/simulated_log.h"
#include "pipeline/state_tool_axes.h"

namespace clsurf::cli {
namespace {

/// Without a pose all positions stay in machine coordinates.
io::ProgramOptions in_coordinates_of(const RunOptions& options, const Log& log) {
    io::ProgramOptions program = options.program_options;
    const bool known = options.poses.zero || log.work_offset;
    program.coordinates = known ? Coordinates::workpiece : Coordinates::machine;
    return program;
}

/// Simulates the program of a run.
void simulate_into(LoadedRun& run, const io::Source& source, const RunOptions& options) {
    run.simulated = true;
    io::ProgramOptions as_programmed = options.program_options;
    as_programmed.coordinates.reset();
    Program program = io::read_program(source, as_programmed);
    if (runs_on_five_axes(program, options.machine)) run.kinematics = options.kinematics;
    run.pose = prepare_run(program, options.machine, options.poses, options.start,
                           *in_coordinates_of(options, run.log).coordinates);
    SimulatedRun made = simulate_to_log(program, options.machine, options.start, {}, run.pose.translation());
    run.log = std::move(made.log);
    run.log.name = program.main().name();
    run.log.diagnostics = program.diagnostics;
    run.log.diagnostics.append(made.summary.diagnostics);
    run.program = std::make_shared<const Program>(std::move(program));
}

}  // namespace

LoadedRun load_run(const std::string& path, const RunOptions& options) {
    LoadedRun run;
    run.name = path;
    const io::Source source = io::open_source(path);
    if (source.bytes.empty()) throw InputError(Place::of_file(source.name), "is empty, expected a program or a log");
    if (is_log(source, options.log_options)) {
        run.log = io::open_log(source, options.log_options);
        run.kinematics = options.kinematics;
        run.pose = zero_of(options.poses, run.log, run.log.diagnostics).value_or(Eigen::Isometry3d::Identity());
        if (!run.kinematics) note_rotary(run.log, shown_role(run.log), run.log.diagnostics);
    } else {
        simulate_into(run, source, options);
    }
    if (run.log.records == 0) throw InputError(Place::of_file(path), "contains no records");
    return run;
}

ComparedRun run_of(const LoadedRun& run, const LoadedRun& other, const RunOptions& options) {
    const Role role = required_common_role(run.log, other.log, options.role);
    ComparedRun compared = compared_run(run.log, other.log, reconstruct(run.log, role, run.pose, run.kinematics));
    compared.derivative = options.derivative;
    return compared;
}

namespace {

/// Lines of a simulated run on five axes. Its program has axes along those of the machine, like `level`.
LineMap lines_on_five_axes(const LoadedRun& run, const Trajectory& path, Diagnostics& diagnostics) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = run.pose.translation();
    const Trajectory level = reconstruct(run.log, path.role, pose, run.kinematics);
    return map_lines(level, run.log, *run.program, true, diagnostics);
}

/// Lines of a log by --program, which becomes the program of the run.
LineMap lines_of_program(LoadedRun& run, const Trajectory& path, const RunOptions& options, Diagnostics& diagnostics) {
    const io::Source source = io::open_source(options.program);
    io::ProgramOptions how = in_coordinates_of(options, run.log);
    if (run.kinematics) how.coordinates.reset();
    Program program = io::read_program(source, how);
    if (run.kinematics) {
        FramePoses poses = options.poses;
        poses.zero = run.pose;
        (void)place_tips_with(program, run.log, poses, run.kinematics.get(), diagnostics);
    }
    diagnostics.append(program.diagnostics);
    const ProgramIdentity identity = io::check_identity(source, run.log, diagnostics);
    LineMap lines = map_lines(path, run.log, program, true, diagnostics, identity);
    // Without kinematics, the path of the axes does not show whether a log of five axes belongs to the program.
    if (run.kinematics || run.log.diagnostics.count("path.rotary") == 0)
        refuse_foreign(lines.match(), program, run.log, options.force, diagnostics);
    run.program = std::make_shared<const Program>(std::move(program));
    return lines;
}

}  // namespace

std::unique_ptr<LineMap> lines_of(LoadedRun& run, const Trajectory& path, const RunOptions& options,
                                  Diagnostics& diagnostics) {
    if (run.simulated && run.kinematics) return std::make_unique<LineMap>(lines_on_five_axes(run, path, diagnostics));
    if (run.simulated) return std::make_unique<LineMap>(map_lines(path, run.log, *run.program, true, diagnostics));
    if (!options.program.empty()) return std::make_unique<LineMap>(lines_of_program(run, path, options, diagnostics));
    return std::make_unique<LineMap>(lines_without_program(run.log, path.count));
}

void state_tool_axes(Trajectory& path, const LoadedRun& run, const LineMap& lines, Diagnostics* diagnostics) {
    if (!run.program) return;
    Diagnostics of_log = run.log.diagnostics;
    clsurf::state_tool_axes(path, *run.program, lines, of_log);
    if (diagnostics != nullptr && of_log.count("path.tool-axis") > 0) note_unknown_axis(*run.program, *diagnostics);
}

}  // namespace clsurf::cli
