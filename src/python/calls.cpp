#include "python/calls.h"

#include <cmath>
#include <span>
#include <utility>

#include "core/error.h"
#include "core/spelling.h"
#include "identify/identify.h"
#include "io/files/compressed.h"
#include "io/formats/program_identity.h"
#include "io/readers/machine_file.h"
#include "io/reports/identify_report.h"
#include "io/reports/run_report.h"
#include "io/reports/simulated_log.h"
#include "io/reports/simulation_origin.h"
#include "pipeline/compare_runs.h"
#include "pipeline/programmed_part.h"

namespace clsurf::python {
namespace {

using Parts = std::vector<std::shared_ptr<LoadedPart>>;

template <typename T, std::size_t n>
T choose(const std::string& option, const std::string& word, const std::string_view (&names)[n], const T (&values)[n]) {
    for (std::size_t i = 0; i < n; ++i) {
        if (word == names[i]) return values[i];
    }
    throw UsageError(option + ": '" + word + "' is not known", did_you_mean(word, names));
}

PartRules rules_of(const PartOptions& options) {
    PartRules rules;
    if (!options.surface.empty())
        rules.role = choose<Role>("surface", options.surface, {"commanded", "feedback", "actual"},
                                  {Role::commanded, Role::feedback, Role::actual});
    rules.derivative = choose<DerivativeMethod>("derivative", options.derivative, {"savgol", "kalman"},
                                                {DerivativeMethod::savgol, DerivativeMethod::kalman});
    rules.poses = poses_of(options);
    if (!options.machine.empty()) io::use_machine(options.machine, rules);
    rules.use_line_channel = !options.ignore_lines;
    rules.accept_foreign = options.force;
    if (!options.tool.empty() && options.tool != "none") rules.tool = parse_tool(options.tool);
    return rules;
}

std::vector<Part> copies(const Parts& parts, Diagnostics& diagnostics) {
    std::vector<Part> copied;
    for (const std::shared_ptr<LoadedPart>& part : parts) {
        copied.push_back(part->part());
        diagnostics.append(part->part().diagnostics);
    }
    return copied;
}

}  // namespace

io::ProgramOptions program_options_of(const PartOptions& options) {
    io::ProgramOptions program;
    program.dialect = options.dialect;
    program.block_delete = options.block_delete;
    program.tools = options.tools;
    return program;
}

io::LogOptions log_options_of(const PartOptions& options) {
    io::LogOptions log;
    log.layout = options.layout;
    log.mapping = options.mapping;
    log.period = options.period;
    if (log.period && !(*log.period > 0 && std::isfinite(*log.period))) throw UsageError("period must be above 0 s");
    return log;
}

FramePoses poses_of(const PartOptions& options) {
    FramePoses poses;
    if (!options.work_offset) return poses;
    const auto& [x, y, z, turn] = *options.work_offset;
    poses.zero = pose_of(Vec3(x, y, z), turn);
    return poses;
}

std::shared_ptr<LoadedPart> read_part(const PartOptions& options) {
    io::PartFiles files{options.program, options.log, program_options_of(options), log_options_of(options),
                        options.tool != "none"};
    return std::make_shared<LoadedPart>(PartRequest{std::move(files), rules_of(options)});
}

std::shared_ptr<LoadedPart> simulate_part(const PartOptions& options, const std::array<double, 3>& start) {
    PartRules rules = rules_of(options);
    const Machine machine = rules.machine ? *rules.machine : Machine{};
    const io::Source source = io::open_source(options.program);
    io::ProgramOptions how = program_options_of(options);
    how.coordinates.reset();
    Program program = io::read_program(source, how);
    rules.identity = ProgramIdentity::same;
    SimulatedPart made = simulated_part(std::move(program), std::move(rules), Vec3(start[0], start[1], start[2]));
    Diagnostics diagnostics = made.part.program.diagnostics;
    diagnostics.append(made.summary.diagnostics);
    std::string report = io::simulation_json(made.summary, diagnostics, machine.fidelity);
    Part part = std::move(made.part);
    part.log.metadata = io::with_simulation("{}", machine);
    part.log.programs = {io::identify(source)};
    if (!part.tool && !how.tools.empty() && options.tool != "none")
        part.tool = io::tool_of_table(how.tools, part.program);
    return std::make_shared<LoadedPart>(std::move(part), std::move(report));
}

std::pair<std::string, std::string> identify_machine(const Parts& parts, const Parts& tests,
                                                     const std::string& machine) {
    if (parts.empty()) throw UsageError("identify needs at least one part");
    const Machine known = machine.empty() ? Machine{} : io::read_machine(machine);
    Diagnostics diagnostics;
    std::vector<Part> fitted = copies(parts, diagnostics);
    const std::vector<Part> tested = copies(tests, diagnostics);
    Identification result = identify_parts(fitted, known);
    cross_validate(fitted, known, result);
    test_runs(tested, result);
    diagnostics.append(result.diagnostics);
    return {io::identification_json(result, diagnostics), io::identified_machine_text(result)};
}

std::string diff_parts(const Parts& parts) {
    if (parts.size() < 2) throw UsageError("diff compares two parts or more");
    ReferenceRun reference(placed_run(parts.front()->part()));
    Diagnostics diagnostics = reference.run().log.diagnostics;
    io::ReportedRuns reported;
    reported.reference = reference.run().name;
    reported.diagnostics = &diagnostics;
    for (std::size_t k = 1; k < parts.size(); ++k) {
        const PlacedRun run = placed_run(parts[k]->part());
        diagnostics.append(run.log.diagnostics);
        reported.runs.push_back({run.name, reference.compare(run, diagnostics).report, {}, {}});
    }
    reported.departures = reference.departures();
    reported.drifted = drifted_run(reported.departures);
    return io::runs_json(reported);
}

}  // namespace clsurf::python
