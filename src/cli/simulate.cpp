// clsurf simulate: simulates the controller.

#include "cli/controller_runs.h"
#include "cli/options.h"
#include "cli/output_format.h"
#include "cli/progress_bar.h"
#include "cli/simulation_text.h"
#include "cli/work_frames.h"
#include "intervals/interval_feeds.h"
#include "io/files/compressed.h"
#include "io/formats/program_identity.h"
#include "io/readers/machine_file.h"
#include "io/readers/program_file.h"
#include "io/reports/fidelity_report.h"
#include "io/reports/simulated_log.h"
#include "io/reports/simulation_origin.h"
#include "pipeline/simulated_log.h"

namespace clsurf::cli {
namespace {

/// The program is traversed repeatedly, so it is kept in memory.
ExitCode run_five_axis(const Program& program, const Machine& machine, const Vec3& zero, const Vec3& start,
                       io::SimulatedLogWriter& log, const po::variables_map& values) {
    ProgressBar bar(read_common(values));
    const FiveAxisSummary summary = simulate_five_axis(
        program, machine, zero, start, [&](std::span<const FiveAxisPoint> points) { log.append(points); },
        bar.callback());
    log.close();
    bar.clear();
    Diagnostics diagnostics = program.diagnostics;
    diagnostics.append(summary.run.diagnostics);
    if (read_json(values)) {
        write_to_stdout(io::simulation_json(summary, machine.kinematics, diagnostics, machine.fidelity));
    } else {
        print(diagnostics, values);
        write_answer(
            summary_text(summary.run) + rotary_text(summary, machine.kinematics) + io::fidelity_line(machine.fidelity),
            values);
    }
    return ExitCode::done;
}

ExitCode run_simulate(const po::variables_map& values) {
    const std::string output = required(values, "output");
    (void)output_format(output, log_formats());
    (void)read_json_beside_output(values);
    if (const std::optional<ControllerCommand> command = read_controller(values))
        return record_on_controller(*command, required(values, "PROGRAM"), output, values);
    const Machine machine =
        values.count("machine") > 0 ? io::read_machine(values["machine"].as<std::string>()) : Machine{};
    const Vec3 start = read_start(values);
    const std::string path = required(values, "PROGRAM");
    const io::Source source = io::open_source(path);
    const bool five_axes = machine.kinematics.has_rotary();
    const FramePoses poses = five_axes ? read_work_offset(values) : FramePoses{};
    if (given(values, "work-offset") && !five_axes)
        throw UsageError("--work-offset is for machines with rotary axes; of three the program's own offsets count");
    const auto open_log = [&](const std::optional<Eigen::Isometry3d>& pose) {
        const std::string metadata =
            io::with_programs(pose_metadata(pose), std::vector<ProgramReference>{io::identify(source)});
        return io::SimulatedLogWriter(output, machine, io::with_simulation(metadata, machine));
    };
    if (five_axes) {
        io::ProgramOptions options = read_program_options(values);
        options.coordinates.reset();
        Program program = io::read_program(source, options);
        const Eigen::Isometry3d pose = prepare_five_axes(program, machine, poses);
        if (machine.controller.feed == FeedRule::intervals) hold_interval_speeds(program, machine);
        const bool known = poses.zero || !pose.translation().isZero(0);
        io::SimulatedLogWriter log = open_log(known ? std::optional(poses.zero.value_or(pose)) : std::nullopt);
        return run_five_axis(program, machine, pose.translation(), start, log, values);
    }
    io::SimulatedLogWriter log = open_log(std::nullopt);
    ProgressBar bar(read_common(values));
    const PointSink append = [&](std::span<const SimulatedPoint> points) { log.append(points); };
    SimulationSummary summary;
    Diagnostics diagnostics;
    if (machine.controller.feed == FeedRule::intervals) {
        Program program = io::read_program(source, read_program_options(values));
        hold_interval_speeds(program, machine);
        summary = simulate(program, machine, start, append, bar.callback());
        diagnostics = program.diagnostics;
    } else {
        const std::unique_ptr<ProgramReader> program = io::open_program(source, read_program_options(values));
        summary = simulate(*program, machine, start, append, bar.callback());
        diagnostics = program->program().diagnostics;
    }
    log.close();
    bar.clear();
    diagnostics.append(summary.diagnostics);
    if (read_json(values)) {
        write_to_stdout(io::simulation_json(summary, diagnostics, machine.fidelity));
    } else {
        print(diagnostics, values);
        write_answer(summary_text(summary) + io::fidelity_line(machine.fidelity), values);
    }
    return ExitCode::done;
}

}  // namespace

Subcommand simulate_subcommand() {
    return {
        .name = "simulate",
        .arguments = "PROGRAM -o run.biip",
        .summary = "simulates the controller: the log that a machine would write",
        .description =
            "Plans and interpolates a program as a controller does: limits of speed, acceleration and jerk,\n"
            "corners rounded within the tolerance, a look-ahead, and a servo loop for each axis. Writes\n"
            "commanded and feedback positions, line and speed, and in the channel limit the limiting factor\n"
            "of each point: 0 at rest, 1 feed, 2 axis or path speed, 3 acceleration, 4 jerk, 5 corner\n"
            "tolerance, 6 chord error, 7 the end of the look-ahead, 8 feed override, 9 block time.\n"
            "Positions are in machine coordinates: work offsets that the program sets are used, all others\n"
            "are zero. With a machine file that has rotary axes, the log has all five axes, --work-offset is\n"
            "the position of the program's zero with both angles at zero, and blocks that an axis cannot\n"
            "follow run slower. With --controller, your own controller runs the program instead, and its log is\n"
            "kept.\n\n"
            "  clsurf simulate part.nc --machine mill.toml -o run.biip\n"
            "  clsurf simulate part.nc --controller 'run_on_kernel.sh {program} {log}' -o run.biip\n"
            "  clsurf render part.nc run.biip --color limit -o why_slow.png",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("output,o", po::value<std::string>()->value_name("FILE"), "the BIIP log");
                // clang-format on
                declare_simulation(options);
                declare_controller(options);
                declare_work_offset(options);
                declare_json(options);
                declare_program_options(options);
            },
        .positional = {"PROGRAM"},
        .run = run_simulate,
    };
}

}  // namespace clsurf::cli
