// clsurf diff: compares runs of a part, by path.

#include <memory>
#include <optional>

#include "cli/pictures/difference_map.h"
#include "cli/runs/diff_options.h"
#include "cli/runs/run_alignment.h"
#include "cli/runs/run_roughness.h"
#include "cli/runs/runs.h"
#include "cli/stage_clock.h"
#include "io/reports/run_report.h"
#include "pipeline/contacts.h"
#include "surface/stitch.h"

namespace clsurf::cli {
namespace {

/// nullptr: neither the log nor a program gives lines.
const LineMap* known_lines(const LineMap& lines, const LoadedRun& run, const RunOptions& options) {
    return run.log.find("line") != nullptr || run.simulated || !options.program.empty() ? &lines : nullptr;
}

void write_result(const io::ReportedRuns& reported, const Diagnostics& diagnostics, bool json,
                  const po::variables_map& values) {
    if (json) return write_to_stdout(io::runs_json(reported));
    print(diagnostics, values);
    write_answer(io::runs_text(reported), values);
}

/// A report without runs yet. Both arguments must outlive it.
io::ReportedRuns reported_against(const LoadedRun& reference, const Diagnostics& diagnostics) {
    io::ReportedRuns reported;
    reported.reference = reference.name;
    reported.diagnostics = &diagnostics;
    return reported;
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
    LoadedRun reference = load_run(options.files.front(), options.runs);
    diagnostics.append(reference.log.diagnostics);
    io::ReportedRuns reported = reported_against(reference, diagnostics);
    std::unique_ptr<LineMap> lines;
    std::unique_ptr<DriftFinder> drift;
    std::optional<CuttingTool> tool;
    ClSurface surface;
    ComparedRun a;
    std::optional<DrawnDifference> shown;
    for (std::size_t k = 1; k < options.files.size(); ++k) {
        clock.begin("read a run");
        LoadedRun loaded = load_run(options.files[k], options.runs);
        diagnostics.append(loaded.log.diagnostics);
        ComparedRun of_reference = run_of(reference, loaded, options.runs);
        const ComparedRun b = run_of(loaded, reference, options.runs);
        if (!lines || of_reference.path.role != a.path.role) {
            if (drift)
                throw InputError(Place::of_file(loaded.name), "has other kinds of positions than the runs before it",
                                 "--surface names one that all have");
            clock.begin("stitch the surface");
            lines = lines_of(reference, of_reference.path, options.runs, diagnostics);
            surface = clsurf::stitch(gather(of_reference.path), *lines);
            drift = std::make_unique<DriftFinder>(surface);
            tool = find_tool(options.runs.tool, &reference.log, reference.program.get(), diagnostics);
        }
        a = std::move(of_reference);
        if (tool) state_tool_axes(a.path, reference, *lines, k == 1 ? &diagnostics : nullptr);
        clock.begin("compare the runs");
        RunDifferences differences = compare_runs(a, surface, b);
        require_alignment(differences, reference.name, loaded.name);
        RunReport report = report_run(a, surface, known_lines(*lines, reference, options.runs), b, differences);
        note_left_out(report, loaded, reference.name, diagnostics);
        if (tool) PartContacts(reference.log, a.path, *lines, surface, *tool).locate(report);
        std::vector<BudgetLine> budget = hold(report, options.budget);
        std::optional<RoughnessChange> roughness;
        if (tool) {
            clock.begin("measure the roughness");
            roughness = roughness_change_of({reference.log, a.path, *lines, surface}, loaded, b, *tool, options.runs);
        }
        reported.runs.push_back({loaded.name, std::move(report), std::move(budget), std::move(roughness)});
        drift->add(differences);
        if (output && !shown) shown = drawn_between(options.files.front(), loaded.name, differences, options.shown);
    }
    reported.departures = drift->departures();
    reported.drifted = drifted_run(reported.departures);
    if (output) {
        clock.begin("draw");
        draw_difference(*shown, a.path, surface, options.look, *output);
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
