#include "cli/programs/repair_inputs.h"

#include <utility>

#include <fmt/format.h>

#include "cli/options/known_tool.h"
#include "cli/options/work_frames.h"
#include "cli/programs/controller_runs.h"
#include "cli/programs/optimize_options.h"
#include "core/error.h"
#include "io/files/compressed.h"
#include "io/formats/program_identity.h"
#include "io/readers/machine_file.h"
#include "io/readers/program_file.h"
#include "pipeline/placement.h"
#include "program/interpret/dialect_rules.h"

namespace clsurf::cli {

RepairInputs read_repair_inputs(const po::variables_map& values, Diagnostics& diagnostics) {
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
    if (in.rules.splines && (five_axes || !in.program.motions.rotary.empty()))
        throw UsageError("--splines is for programs on three axes");
    if (in.rules.splines && in.program.dialect->rules->text.splines == SplineForm::none)
        throw UsageError(fmt::format("--splines: {} has no splines that can be written", in.program.dialect->name));
    in.measured = read_measured(values, five_axes);
    FramePoses poses = read_work_offset(values);
    if (in.measured) poses.zero = zero_of(poses, *in.measured, in.measured->diagnostics);
    poses.tool_by_kinematics = five_axes;
    // Axes along those of the machine, because its limits apply to them.
    const Eigen::Isometry3d zero = place_motions(in.program, poses, Coordinates::level);
    in.reader = {source, read_program_options(values), std::string(in.program.dialect->name), poses};
    diagnostics.append(in.program.diagnostics);
    in.rules.tool = find_tool(read_tool(values), in.measured ? &*in.measured : nullptr, &in.program, diagnostics);
    if (in.measured) in.rules.identity = io::check_identity(source, *in.measured, diagnostics);
    in.rounds = read_rounds(values);
    const bool fitted_later = values.count("controller") > 0 || !in.rounds.empty();
    if (in.measured && !has_machine && !fitted_later && in.rules.identity != ProgramIdentity::other) {
        in.machine = io::fitted_machine(in.reader, {{std::string(in.program.main().text()), *in.measured}}, in.machine,
                                        diagnostics);
        if (in.machine.fidelity) in.machine_origin = "fitted to " + in.measured->name;
    }
    std::vector<Log*> logs;
    if (in.measured) logs.push_back(&*in.measured);
    for (EarlierRound& round : in.rounds) logs.push_back(&round.run.log);
    for (Log* log : logs) {
        log->work_offset = zero.translation();
        log->work_rotation = 0;
    }
    if (five_axes) in.rules.zero = zero.translation();
    return in;
}

Optimized run_repair(const po::variables_map& values, RepairInputs& in, const Progress& progress,
                     Diagnostics& diagnostics) {
    const ReadProgram read = [&](const std::string& text) { return in.reader.level(text); };
    const std::optional<ControllerCommand> command = read_controller(values);
    const int runs = read_runs(values);
    if (!command && in.rounds.empty())
        return optimize(in.program, read, in.machine, in.rules, std::move(in.measured), progress, diagnostics);
    if (runs_on_five_axes(in.program, in.machine))
        throw UsageError("--controller and --round are for programs on three axes");
    std::optional<ControllerRuns> controller;
    if (command) controller.emplace(*command, in.reader);
    ControllerJudge judge{nullptr,
                          [&](const std::vector<ControllerLog>& logs, const Machine& known) {
                              return io::fitted_machine(in.reader, logs, known, diagnostics);
                          },
                          runs};
    if (controller) judge.run = [&](const std::string& text) { return controller->run(text); };
    in.machine_origin += controller ? ", fitted to the runs of the controller"
                                    : fmt::format(", fitted to {} logs", 1 + in.rounds.size());
    return optimize_on_controller(in.program, read, in.machine, in.rules, judge, std::move(in.measured), in.rounds,
                                  progress, diagnostics);
}

}  // namespace clsurf::cli
