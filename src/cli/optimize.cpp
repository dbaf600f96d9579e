// clsurf optimize: a smoother program within a tolerance, verified by simulation.

#include <memory>

#include <fmt/format.h>

#include "cli/controller_runs.h"
#include "cli/fitted_machine.h"
#include "cli/known_tool.h"
#include "cli/optimize_options.h"
#include "cli/optimize_picture.h"
#include "cli/options.h"
#include "cli/output_format.h"
#include "cli/picture_output.h"
#include "cli/progress_bar.h"
#include "cli/work_frames.h"
#include "io/files/atomic_file.h"
#include "io/files/compressed.h"
#include "io/formats/program_identity.h"
#include "io/readers/machine_file.h"
#include "io/readers/program_file.h"
#include "io/reports/optimize_report.h"
#include "pipeline/placement.h"
#include "repair/optimizer.h"

namespace clsurf::cli {
namespace {

/// What a program is repaired from.
struct RepairInputs {
    OptimizeRules rules;
    Machine machine;
    std::string machine_origin;  ///< a clause
    std::optional<Log> measured;
    TextReader reader;
    Program program;
};

RepairInputs read_inputs(const po::variables_map& values, Diagnostics& diagnostics) {
    RepairInputs in;
    in.rules = read_optimize_rules(values);
    const bool has_machine = values.count("machine") > 0;
    in.machine_origin = has_machine ? values["machine"].as<std::string>() : "that of clsurf machine --defaults";
    if (has_machine) in.machine = io::read_machine(in.machine_origin);
    const io::Source source = io::open_source(required(values, "PROGRAM"));
    io::ProgramOptions as_programmed = read_program_options(values);
    as_programmed.coordinates.reset();
    in.program = io::read_program(source, as_programmed);
    const bool five_axes = runs_on_five_axes(in.program, in.machine);
    in.measured = read_measured(values, five_axes);
    FramePoses poses = read_work_offset(values);
    if (in.measured) poses.zero = zero_of(poses, *in.measured, in.measured->diagnostics);
    poses.tool_by_kinematics = five_axes;
    // Its axes along those of the machine, whose limits count.
    const Eigen::Isometry3d zero = place_motions(in.program, poses, Coordinates::level);
    in.reader = {source, read_program_options(values), std::string(in.program.dialect->name), poses};
    diagnostics.append(in.program.diagnostics);
    in.rules.tool = find_tool(read_tool(values), in.measured ? &*in.measured : nullptr, &in.program, diagnostics);
    if (in.measured) in.rules.identity = io::check_identity(source, *in.measured, diagnostics);
    const bool fitted_later = values.count("controller") > 0;
    if (in.measured && !has_machine && !fitted_later && in.rules.identity != ProgramIdentity::other) {
        in.machine =
            fitted_machine(in.reader, {{std::string(in.program.main().text()), *in.measured}}, in.machine, diagnostics);
        if (in.machine.fidelity) in.machine_origin = "fitted to " + in.measured->name;
    }
    if (in.measured) in.measured->work_offset = zero.translation();
    if (in.measured) in.measured->work_rotation = 0;
    if (five_axes) in.rules.zero = zero.translation();
    return in;
}

Optimized run_repair(const po::variables_map& values, RepairInputs& in, const Progress& progress,
                     Diagnostics& diagnostics) {
    const ReadProgram read = [&](const std::string& text) { return in.reader.level(text); };
    const std::optional<ControllerCommand> command = read_controller(values);
    const int runs = read_runs(values);
    if (!command)
        return optimize(in.program, read, in.machine, in.rules, std::move(in.measured), progress, diagnostics);
    if (runs_on_five_axes(in.program, in.machine)) throw UsageError("--controller is for programs on three axes");
    const ControllerRuns controller(*command, in.reader);
    const ControllerJudge judge{[&](const std::string& text) { return controller.run(text); },
                                [&](const std::vector<ControllerLog>& logs, const Machine& known) {
                                    return fitted_machine(in.reader, logs, known, diagnostics);
                                },
                                runs};
    in.machine_origin += ", fitted to the runs of the controller";
    return optimize_on_controller(in.program, read, in.machine, in.rules, judge, std::move(in.measured), progress,
                                  diagnostics);
}

ExitCode run_optimize(const po::variables_map& values) {
    const std::string output_path = required(values, "output");
    require_program_ending(output_path);
    const bool json = read_json_beside_output(values);
    Diagnostics diagnostics;
    RepairInputs in = read_inputs(values, diagnostics);
    io::AtomicFile output(output_path);
    std::optional<PictureOutput> picture;
    if (values.count("picture") > 0) picture.emplace(values["picture"].as<std::string>(), "--picture");
    ProgressBar bar(read_common(values));
    Optimized result = run_repair(values, in, bar.callback(), diagnostics);
    result.machine = in.machine_origin;
    bar.clear();
    if (json) {
        write_to_stdout(io::optimize_json(result, diagnostics));
    } else {
        print(diagnostics, values);
        write_answer(io::optimize_text(result), values);
    }
    const std::string name = in.program.main().name();
    if (picture) {
        picture->write(draw_before_and_after(result, name),
                       fmt::format("clsurf optimize of {}: speeds before and after", name));
    }
    if (!result.evaluation.accepted) return ExitCode::check_failed;
    output.write(result.text);
    output.commit();
    return ExitCode::done;
}

}  // namespace

Subcommand optimize_subcommand() {
    return {
        .name = "optimize",
        .arguments = "PROGRAM -o better.nc",
        .summary = "a smoother program within a tolerance, verified by simulation",
        .description =
            "Simulates the program, aligns the points of its finishing passes with those of adjacent passes\n"
            "on the smoothest curve within the tolerance, and simulates it again. The new program is written\n"
            "only if it is better: speeds of adjacent passes differ less, there are no more defects, it does\n"
            "not take longer (or at most by --more-time), and it stays within the tolerance. Otherwise the\n"
            "exit code is 1, with the reason. Lines that contain anything but line number, G1, X, Y, Z, A, B,\n"
            "C are kept byte for byte. With --tool, the machined surface must not get rougher either.\n"
            "It must also be better on other machines that the machine file allows (--machines). With --log and\n"
            "without --machine, the machine is fitted to the log. With --controller, your own controller runs the\n"
            "program and the best candidates, --runs times in all, and its logs decide.\n"
            "Programs that move rotary axes need a machine file that has them. Passes are then those of the\n"
            "tool tip, and the tool axis stays within a hundredth of a degree of the programmed one.\n\n"
            "  clsurf optimize part.nc --machine mill.toml --tolerance 0.005 -o better.nc --picture better.png\n"
            "  clsurf optimize part.nc --log run.biip -o better.nc\n"
            "  clsurf optimize part.nc --controller 'run_on_kernel.sh {program} {log}' --runs 4 -o better.nc",
        .declare = declare_optimize,
        .positional = {"PROGRAM"},
        .run = run_optimize,
    };
}

}  // namespace clsurf::cli
