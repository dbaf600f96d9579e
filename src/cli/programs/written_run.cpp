#include "cli/programs/written_run.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cli/options/work_frames.h"
#include "cli/progress_bar.h"
#include "intervals/interval_feeds.h"
#include "io/files/compressed.h"
#include "io/formats/program_identity.h"
#include "io/readers/program_file.h"
#include "io/reports/simulated_log.h"
#include "io/reports/simulation_origin.h"
#include "pipeline/simulated_log.h"

namespace clsurf::cli {
namespace {

/// The program is traversed repeatedly, so it is kept in memory.
WrittenRun run_five_axis(const Program& program, const Machine& machine, const Vec3& zero, io::SimulatedLogWriter& log,
                         const po::variables_map& values) {
    ProgressBar bar(read_common(values));
    WrittenRun run;
    run.five_axes = true;
    run.summary = simulate_five_axis(
        program, machine, zero, read_start(values), [&](std::span<const FiveAxisPoint> points) { log.append(points); },
        bar.callback());
    log.close();
    run.diagnostics = program.diagnostics;
    run.diagnostics.append(run.summary.run.diagnostics);
    return run;
}

WrittenRun run_three_axis(const io::Source& source, const Machine& machine, io::SimulatedLogWriter& log,
                          const po::variables_map& values) {
    ProgressBar bar(read_common(values));
    const PointSink append = [&](std::span<const SimulatedPoint> points) { log.append(points); };
    const Vec3 start = read_start(values);
    WrittenRun run;
    if (machine.controller.feed == FeedRule::intervals) {
        Program program = io::read_program(source, read_program_options(values));
        hold_interval_speeds(program, machine);
        run.summary.run = simulate(program, machine, start, append, bar.callback());
        run.diagnostics = program.diagnostics;
    } else {
        const std::unique_ptr<ProgramReader> program = io::open_program(source, read_program_options(values));
        run.summary.run = simulate(*program, machine, start, append, bar.callback());
        run.diagnostics = program->program().diagnostics;
    }
    log.close();
    run.diagnostics.append(run.summary.run.diagnostics);
    return run;
}

}  // namespace

WrittenRun write_run(const Machine& machine, const std::string& output, const po::variables_map& values) {
    const io::Source source = io::open_source(required(values, "PROGRAM"));
    const auto open_log = [&](const std::optional<Eigen::Isometry3d>& pose) {
        const std::string metadata =
            io::with_programs(pose_metadata(pose), std::vector<ProgramReference>{io::identify(source)});
        return io::SimulatedLogWriter(output, machine, io::with_simulation(metadata, machine));
    };
    if (!machine.kinematics.has_rotary()) {
        if (given(values, "work-offset"))
            throw UsageError(
                "--work-offset is for machines with rotary axes; of three the program's own offsets count");
        io::SimulatedLogWriter log = open_log(std::nullopt);
        return run_three_axis(source, machine, log, values);
    }
    const FramePoses poses = read_work_offset(values);
    io::ProgramOptions options = read_program_options(values);
    options.coordinates.reset();
    Program program = io::read_program(source, options);
    const Eigen::Isometry3d pose = prepare_five_axes(program, machine, poses, read_start(values));
    if (machine.controller.feed == FeedRule::intervals) hold_interval_speeds(program, machine);
    const bool known = poses.zero || !pose.translation().isZero(0);
    io::SimulatedLogWriter log = open_log(known ? std::optional(poses.zero.value_or(pose)) : std::nullopt);
    return run_five_axis(program, machine, pose.translation(), log, values);
}

}  // namespace clsurf::cli
