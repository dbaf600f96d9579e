// clsurf check: adjacent-path discontinuities and the marks that they will leave.

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "cli/defect_colours.h"
#include "cli/part.h"
#include "cli/quality_limits.h"
#include "cli/report_output.h"
#include "cli/stage_clock.h"
#include "cli/terminal.h"
#include "io/readers/accepted_file.h"
#include "io/reports/acceptance.h"
#include "io/reports/quality_report.h"
#include "io/reports/simulation_origin.h"
#include "pipeline/judge.h"
#include "pipeline/limits_of.h"

namespace clsurf::cli {
namespace {

constexpr const char* check_formats = "text|json|csv|sarif";

using QualityWriter = std::string (*)(const io::ReportedQuality&);

QualityWriter writer_of(const std::string& format) {
    static const std::map<std::string, QualityWriter, std::less<>> writers{
        {"text", io::quality_text}, {"json", io::quality_json}, {"csv", io::quality_csv}, {"sarif", io::quality_sarif}};
    return writers.at(format);
}

/// One log's report, and what it comes to.
struct Checked {
    std::string text;
    ExitCode code = ExitCode::done;
};

Checked check_log(const PartOptions& options, std::optional<Role> measured, const CheckBudget& budget,
                  const std::optional<io::AcceptedFile>& accepted, const std::string& format,
                  const po::variables_map& values) {
    StageClock clock(read_common(values), 8);
    Part part = load_part(options, clock);
    clock.begin("stitch the surface");
    const ClSurface surface = stitch(part);
    const Quality quality = judge(part, surface, measured, {}, clock.stages());
    part.diagnostics.append(quality.diagnostics);
    LimitReport limits;
    if (const std::vector<StatedLimit> stated = stated_limits(part.limits, budget); !stated.empty()) {
        clock.begin("compare with the limits");
        limits = judge_limits(part, stated);
        part.diagnostics.append(limits.diagnostics);
    }

    io::ReportedQuality reported;
    reported.report = &quality.report;
    reported.program = &part.program;
    reported.log = part.log.name;
    reported.tool = part.tool;
    reported.scallop = quality.scallop;
    if (format == "json") reported.colour_differences = colour_differences(quality.report, part);
    reported.as_machined = quality.as_machined ? &*quality.as_machined : nullptr;
    if (!options.machine.empty() || budget.limits.max_following_error_um) reported.limits = &limits;
    io::Acceptance acceptance;
    if (accepted) {
        acceptance = io::accept(quality.report, *accepted);
        io::note_changes(acceptance, quality.report, part.diagnostics);
        reported.acceptance = &acceptance;
    }
    reported.budget =
        hold(accepted ? io::without_accepted(quality.report, acceptance) : quality.report, budget.quality);
    const std::vector<BudgetLine> held = hold(limits, budget.limits);
    reported.budget.insert(reported.budget.end(), held.begin(), held.end());
    reported.origin = io::simulation_origin(part.log);
    reported.diagnostics = &part.diagnostics;
    if (values.count("output") == 0) reported.columns = table_columns();
    clock.end();
    if (format != "json") print(part.diagnostics, values);
    const ExitCode code = code_of(quality.report.judgement.judged(), reported.budget, held, budget);
    return {writer_of(format)(reported), code};
}

ExitCode run_check(const po::variables_map& values) {
    PartOptions options = read_part_options(values);
    const std::optional<Role> measured = take_measured_role(options);
    const CheckBudget budget = read_limits(values);
    std::optional<io::AcceptedFile> accepted;
    if (values.count("accepted") > 0) accepted = io::read_accepted(values["accepted"].as<std::string>());
    const std::vector<std::string> logs = values["LOG"].as<std::vector<std::string>>();
    if (logs.size() > 1 && options.program == "-")
        throw UsageError("the program of several logs cannot come from standard input");
    ReportOutput output(values, check_formats);
    std::vector<std::string> texts;
    ExitCode worst = ExitCode::done;
    for (const std::string& log : logs) {
        options.log = log;
        Checked checked = check_log(options, measured, budget, accepted, output.format(), values);
        texts.push_back(std::move(checked.text));
        worst = std::max(worst, checked.code);
    }
    const std::string report = joined_reports(logs, texts, output.format());
    const bool to_terminal = output.format() == "text" && values.count("output") == 0;
    output.write(to_terminal ? fit_terminal(report) : report);
    return worst;
}

}  // namespace

Subcommand check_subcommand() {
    return {
        .name = "check",
        .arguments = "PROGRAM LOG…",
        .summary = "finds differences between adjacent passes and predicts the marks: lines, causes, depths",
        .description =
            "Compares every pass with its neighbours: speed, acceleration, and the deviation of the axes from\n"
            "the commanded path. The output begins with a verdict and lists the differences that are large\n"
            "enough to leave a mark, most conspicuous first, with the responsible lines and the predicted\n"
            "depth.\n"
            "Severity: 1 trace (in the data, hardly on the part), 2 visible (on a polished or glossy\n"
            "surface), 3 distinct (on any finished surface), 4 reject (too deep to polish out). A speed below\n"
            "that of the neighbours is negative. Depths have no sign but a shape, pit or bulge.\n"
            "With --machine every record of the commanded motion is compared with the limits that the machine\n"
            "file states, and with the path tolerance of the program: axis, factor, line, time (docs/limits.md).\n"
            "The exit code is 1 if a limit of --budget, --fail-on or --max-depth is exceeded, and 5 if the\n"
            "data do not allow a verdict: less than half of the cutting points could be compared.\n\n"
            "  clsurf check part.nc run.biip --tool ball:6\n"
            "  clsurf check part.nc run.biip --machine mill.toml --budget limits.toml\n"
            "  clsurf check part.nc monday.biip friday.biip --fail-on distinct --max-depth 5um -q\n"
            "  clsurf check part.nc run.biip --tool ball:6 --budget part.toml --format sarif -o part.sarif",
        .declare =
            [](po::options_description& options) {
                declare_tool(options);
                // clang-format off
                options.add_options()
                    ("budget", po::value<std::string>()->value_name("FILE"), "limits (TOML); exit code 1 if one is exceeded")
                    ("fail-on", po::value<std::string>()->value_name(severity_words), "exit code 1 if a defect has at least this severity")
                    ("accepted", po::value<std::string>()->value_name("FILE"), "accepted defects (JSON, from the page of report): they are listed, and no limit counts them")
                    ("max-depth", po::value<std::string>()->value_name("LENGTH"), "exit code 1 if a defect is deeper, for example 5um or 0.005mm");
                // clang-format on
                declare_report_output(options, check_formats);
                declare_part(options);
            },
        .positional = {"PROGRAM", "LOG…"},
        .run = run_check,
    };
}

}  // namespace clsurf::cli
