// clsurf lint: problems in the program itself.

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "cli/options/known_tool.h"
#include "cli/options/options.h"
#include "cli/options/report_output.h"
#include "io/readers/program_file.h"
#include "io/reports/lint_report.h"
#include "lint/contact_places.h"

namespace clsurf::cli {
namespace {

constexpr const char* lint_formats = "text|json|sarif";

using LintWriter = std::string (*)(std::span<const io::ReportedLint>);

io::ReportedLint lint_program(const std::string& path, const io::ProgramOptions& options,
                              const LintThresholds& thresholds, const ToolChoice& choice) {
    const Program program = io::read_program(path, options);
    const ProgrammedSurface programmed = build_programmed_surface(program);
    io::ReportedLint linted{program.main().name(), lint(program, programmed, thresholds), program.diagnostics};
    if (const std::optional<CuttingTool> tool = find_tool(choice, nullptr, &program, linted.diagnostics))
        add_contacts(linted.report, program, programmed, *tool);
    return linted;
}

ExitCode run_lint(const po::variables_map& values) {
    static const std::map<std::string, LintWriter, std::less<>> writers{
        {"text", io::lint_text}, {"json", io::lint_json}, {"sarif", io::lint_sarif}};
    LintThresholds thresholds;
    if (values.count("tolerance") > 0) {
        thresholds.tolerance = values["tolerance"].as<double>();
        if (!(thresholds.tolerance > 0) || !std::isfinite(thresholds.tolerance))
            throw UsageError("--tolerance must be above 0 mm");
    }
    const ToolChoice choice = read_tool(values);
    const io::ProgramOptions options = read_program_options(values);
    if (values.count("PROGRAM") == 0) throw UsageError("missing argument: PROGRAM");
    ReportOutput output(values, lint_formats);
    std::vector<io::ReportedLint> programs;
    for (const std::string& path : values["PROGRAM"].as<std::vector<std::string>>()) {
        programs.push_back(lint_program(path, options, thresholds, choice));
        if (output.format() != "json") print(programs.back().diagnostics, values);
    }
    output.write(writers.at(output.format())(programs));
    const bool warned = std::ranges::any_of(programs, [](const auto& p) { return p.report.warnings() > 0; });
    return warned ? ExitCode::check_failed : ExitCode::done;
}

}  // namespace

Subcommand lint_subcommand() {
    return {
        .name = "lint",
        .arguments = "PROGRAM…",
        .summary = "lists problems in the program itself: uneven points, chord errors, reversals, feeds, pass ends",
        .description =
            "Compares adjacent programmed passes, without a log, and lists the lines that a controller will\n"
            "run differently from their neighbours: points closer or farther apart than on both adjacent\n"
            "passes, chord errors against the controller's tolerance (a good tolerance is 110 to 200 % of the\n"
            "chord error), short lines that run backward, different feeds, pass ends that are out of line.\n"
            "For several programs, the report begins with a table. Exit code 1 means that one has warnings.\n\n"
            "  clsurf lint part.nc\n"
            "  clsurf lint *.nc -o lint.sarif\n"
            "  clsurf lint part.nc --tolerance 0.01 --format sarif -o part.sarif",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("tolerance", po::value<double>()->value_name("MM"), "path tolerance of the controller (default: what the program sets by G64 P, CYCLE832 or cycle 32)");
                // clang-format on
                declare_tool(
                    options,
                    "the tool, diameter and corner radius in mm; places are then contact points on the part, otherwise tool tips (default: from --tools)");
                declare_report_output(options, lint_formats);
                declare_program_options(options);
            },
        .positional = {"PROGRAM…"},
        .run = run_lint,
    };
}

}  // namespace clsurf::cli
