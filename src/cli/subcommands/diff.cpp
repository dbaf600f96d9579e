// clsurf diff: compares runs of a part, by path.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/pictures/difference_map.h"
#include "cli/runs/diff_options.h"
#include "cli/runs/runs.h"
#include "cli/stage_clock.h"
#include "io/reports/run_report.h"

namespace clsurf::cli {
namespace {

void write_result(const io::ReportedRuns& reported, const Diagnostics& diagnostics, bool json,
                  const po::variables_map& values) {
    if (json) return write_to_stdout(io::runs_json(reported));
    print(diagnostics, values);
    write_answer(io::runs_text(reported), values);
}

/// A report without runs yet. Both arguments must outlive it.
io::ReportedRuns reported_against(const PlacedRun& reference, const Diagnostics& diagnostics) {
    io::ReportedRuns reported;
    reported.reference = reference.name;
    reported.diagnostics = &diagnostics;
    return reported;
}

/// Warns if B has a path that A does not have: it is not compared.
void note_left_out(const RunReport& report, const PlacedRun& b, const std::string& a, Diagnostics& diagnostics) {
    constexpr double few = 0.02;  // allows another approach or retract
    const double left_out = report.arc_length_of_b - report.aligned_of_b;
    if (left_out <= few * report.arc_length_of_b) return;
    const PointRange& points = report.left_out_of_b;
    diagnostics.add(
        {Severity::warning, "compare.left-out", Place::of_file(b.name),
         fmt::format(
             "{:.1f} of its {:.1f} mm are not compared: {} has no such path, or has it only once. Longest part: "
             "points {}–{}, {:.3f} s",
             left_out, report.arc_length_of_b, a, points.first, points.last,
             b.log.time_of(points.last) - b.log.time_of(points.first)),
         "a second run in this log, or lines that ran twice? Where it is the first argument, all its runs are compared"});
}

/// Opens the file of the map, if one is requested.
void open_map(DiffOptions& options, std::optional<PictureOutput>& output) {
    if (options.output.empty()) return;
    output.emplace(options.output, "-o", PictureKind::drawing);
    options.look.look.keep_drawing = output->wants_drawing();
}

DrawnDifference drawn_between(const std::string& reference, const std::string& run, RunDifferences& differences,
                              RunQuantity quantity) {
    DrawnDifference shown = drawn_difference(differences, quantity);
    shown.reference = reference;
    shown.run = run;
    return shown;
}

ExitCode run_diff(const po::variables_map& values) {
    DiffOptions options = read_diff_options(values);
    std::optional<PictureOutput> output;
    open_map(options, output);
    StageClock clock(read_common(values), 2 + 3 * static_cast<int>(options.files.size()));
    Diagnostics diagnostics;
    clock.begin("read the reference");
    ReferenceRun reference(load_run(options.files.front(), options.runs), comparison_rules(options.runs));
    diagnostics.append(reference.run().log.diagnostics);
    io::ReportedRuns reported = reported_against(reference.run(), diagnostics);
    std::optional<DrawnDifference> shown;
    for (std::size_t k = 1; k < options.files.size(); ++k) {
        clock.begin("read a run");
        const PlacedRun run = load_run(options.files[k], options.runs);
        diagnostics.append(run.log.diagnostics);
        ComparedWithReference compared = reference.compare(run, diagnostics, clock.stages());
        note_left_out(compared.report, run, reported.reference, diagnostics);
        std::vector<BudgetLine> budget = hold(compared.report, options.budget);
        if (output && !shown) shown = drawn_between(reported.reference, run.name, compared.differences, options.shown);
        reported.runs.push_back(
            {run.name, std::move(compared.report), std::move(budget), std::move(compared.roughness)});
    }
    reported.departures = reference.departures();
    reported.drifted = drifted_run(reported.departures);
    if (output) {
        clock.begin("draw");
        draw_difference(*shown, reference.path(), reference.surface(), options.look, *output);
    }
    clock.end();
    write_result(reported, diagnostics, options.json, values);
    return reported.within_budget() ? ExitCode::done : ExitCode::check_failed;
}

}  // namespace

Subcommand diff_subcommand() {
    return {
        .name = "diff",
        .arguments = "A B…",
        .summary = "compares runs of a part by path: speed, acceleration, lag and height",
        .description =
            "Aligns runs with the first one by path, not by time, so overrides, pauses,\n"
            "other periods and partial logs do not matter. Lists where speed,\n"
            "acceleration, lag along the feed, height and jerk (its root mean square over 50 ms: how rough the\n"
            "motion is) differ: B minus A. If the tool is known, it also gives the roughness that each run\n"
            "leaves. Each argument is a log, or a program, which is simulated. With a budget, exit code 1 means that a limit is exceeded. With\n"
            "three or more runs, the one that deviates from the others is named. The map shows the first B.\n\n"
            "  clsurf diff monday.biip friday.biip --program part.nc\n"
            "  clsurf diff monday.biip friday.biip --budget runs.toml -o difference.png --color height\n"
            "  clsurf diff part.nc part_smoothed.nc --machine mill.toml",
        .declare = declare_diff,
        .positional = {"A", "B…"},
        .run = run_diff,
    };
}

}  // namespace clsurf::cli
