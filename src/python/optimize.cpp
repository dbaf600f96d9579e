#include "python/optimize.h"

#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "core/version.h"
#include "io/files/compressed.h"
#include "io/formats/program_identity.h"
#include "io/readers/fitted_machine.h"
#include "io/readers/machine_file.h"
#include "io/reports/optimize_report.h"
#include "io/reports/tradeoff_report.h"
#include "pipeline/placement.h"
#include "pipeline/simulated_log.h"
#include "python/tradeoff.h"
#include "repair/optimizer.h"

namespace clsurf::python {
namespace {

OptimizeRules rules_of(const RepairOptions& repair) {
    constexpr int most_machines = 100, most_decimals = 9;
    OptimizeRules rules;
    rules.tolerance = repair.tolerance;
    rules.more_time = repair.more_time_percent / 100;
    rules.machines = repair.machines;
    rules.least_decimals = repair.decimals;
    if (!(rules.tolerance > 0) || !std::isfinite(rules.tolerance)) throw UsageError("tolerance must be above 0 mm");
    if (!(rules.more_time >= 0) || rules.more_time > 1) throw UsageError("more_time_percent must be 0 to 100");
    if (rules.machines < 0 || rules.machines > most_machines) throw UsageError("machines must be 0 to 100");
    if (rules.least_decimals < 0 || rules.least_decimals > most_decimals) throw UsageError("decimals must be 0 to 9");
    if (repair.feeds != "searched" && repair.feeds != "intervals")
        throw UsageError("feeds: '" + repair.feeds + "' is not searched or intervals");
    rules.feeds = repair.feeds == "intervals" ? FeedChoice::intervals : FeedChoice::searched;
    require_weight(repair.weight);
    rules.keeps_front = repair.tradeoff || repair.weight;
    rules.weight = repair.weight;
    rules.header = fmt::format("clsurf {} optimize, tolerance {} mm", version, rules.tolerance);
    return rules;
}

/// What is given, else what the log or the tool table tells.
std::optional<CuttingTool> tool_of(const PartOptions& options, const std::optional<Log>& log, const Program& program) {
    if (options.tool == "none") return std::nullopt;
    if (!options.tool.empty()) return parse_tool(options.tool);
    if (log) {
        if (const std::optional<CuttingTool> recorded = io::tool_of_log(*log)) return recorded;
    }
    return options.tools.empty() ? std::nullopt : io::tool_of_table(options.tools, program);
}

}  // namespace

RepairedProgram optimize_program(const PartOptions& options, const RepairOptions& repair) {
    OptimizeRules rules = rules_of(repair);
    Machine machine = options.machine.empty() ? Machine{} : io::read_machine(options.machine);
    std::string origin = options.machine.empty() ? "that of clsurf machine --defaults" : options.machine;
    const io::Source source = io::open_source(options.program);
    io::TextReader reader{source, program_options_of(options), {}, {}};
    io::ProgramOptions as_programmed = reader.options;
    as_programmed.coordinates.reset();
    Program program = io::read_program(source, as_programmed);
    reader.dialect = std::string(program.dialect->name);
    std::optional<Log> log;
    if (!options.log.empty()) log = io::open_log(options.log, log_options_of(options));

    const bool five_axes = runs_on_five_axes(program, machine);
    reader.poses = poses_of(options);
    Diagnostics diagnostics;
    if (log) reader.poses.zero = zero_of(reader.poses, *log, log->diagnostics);
    reader.poses.tool_by_kinematics = five_axes;
    const Vec3 zero = place_motions(program, reader.poses, Coordinates::level).translation();
    if (five_axes) rules.zero = zero;
    diagnostics.append(program.diagnostics);
    rules.tool = tool_of(options, log, program);
    if (log) {
        rules.identity = io::check_identity(source, *log, diagnostics);
        if (options.machine.empty() && rules.identity != ProgramIdentity::other) {
            machine = io::fitted_machine(reader, {{std::string(program.main().text()), *log}}, machine, diagnostics);
            if (machine.fidelity) origin = "fitted to " + log->name;
        }
        log->work_offset = zero;
        log->work_rotation = 0;
    }
    const ReadProgram read = [&](const std::string& text) { return reader.level(text); };
    Optimized result = optimize(program, read, machine, rules, std::move(log), {}, diagnostics);
    result.machine = origin;
    return {io::optimize_json(result, diagnostics), result.evaluation.accepted ? result.text : std::string(),
            rules.keeps_front ? io::tradeoff_json(result.front, {}, diagnostics) : std::string()};
}

}  // namespace clsurf::python
