// clsurf diff: runs of a part against each other, by path.

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/look.h"
#include "cli/picture_output.h"
#include "cli/runs.h"
#include "cli/stage_clock.h"
#include "core/file_name.h"
#include "core/spelling.h"
#include "io/budget_file.h"
#include "io/run_report.h"
#include "pipeline/contacts.h"

namespace clsurf::cli {
namespace {

/// Ends of the colours: nearly all of what differs, however short the stretch is.
constexpr double shown_percentile = 99.9;

struct DiffOptions {
    std::vector<std::string> files;  ///< the reference first
    RunOptions runs;
    RunBudget budget;
    std::string output;  ///< of the map; empty: none
    RunQuantity shown = RunQuantity::speed;
    LookOptions look;
    bool json = false;
};

RunQuantity parse_quantity(const std::string& text) {
    std::vector<std::string_view> names;
    for (const RunQuantityInfo& info : run_quantity_table()) {
        if (info.name == text) return info.quantity;
        names.push_back(info.name);
    }
    throw UsageError("--color: '" + text + "' is not speed, acceleration, lag or height", did_you_mean(text, names));
}

DiffOptions read_diff_options(const po::variables_map& values) {
    DiffOptions options;
    options.files.push_back(required(values, "A"));
    if (values.count("B") == 0) throw UsageError("missing argument: B");
    for (const std::string& file : values["B"].as<std::vector<std::string>>()) options.files.push_back(file);
    options.runs = read_run_options(values);
    if (values.count("budget") > 0) options.budget = io::read_run_budget(values["budget"].as<std::string>());
    options.output = text_of(values, "output", "");
    options.shown = parse_quantity(text_of(values, "color", "speed"));
    options.look = read_look_options(values);
    options.json = read_json_beside_output(values);
    return options;
}

/// Nothing of B lies on A: another part, or another work offset.
void require_alignment(const RunDifferences& differences, const std::string& a, const std::string& b) {
    if (differences.alignment.aligned > 0) return;
    throw InputError(
        Place::of_file(b), "nowhere runs along the path of " + a,
        "another part, or another work offset? --work-offset holds for all runs; `clsurf info` tells what a log knows");
}

/// The map of one quantity: what is drawn, and what it is called.
struct DrawnDifference {
    Field field;
    std::string run;
    PointIndex compared = 0;
};

DrawnDifference drawn(RunDifferences& differences, RunQuantity quantity, const std::string& run) {
    const RunQuantityInfo& info = run_quantity_table()[index_of(quantity)];
    if (!differences.has(quantity))
        throw UsageError(fmt::format("--color {}: the runs do not have measured positions in common", info.name));
    DrawnDifference shown;
    shown.run = run;
    shown.field.info = {
        std::string(info.name), fmt::format("{}, difference", info.label), info.unit, FieldScale::diverging, {}};
    shown.field.values = std::move(differences.of[index_of(quantity)]);
    return shown;
}

/// Even about 0, and never narrower than what counts as a difference: equal runs are not to look different.
ShownRange range_of(const DrawnDifference& shown, const ClSurface& surface, const LookOptions& options,
                    double threshold) {
    RangeRule rule = options.range;
    const bool automatic = rule.kind == RangeRule::Kind::automatic;
    if (automatic) rule = {RangeRule::Kind::percentiles, 100 - shown_percentile, shown_percentile};
    ShownRange range = find_range(shown.field, surface.passes, rule);
    if (!automatic) return range;
    const double most =
        std::max({std::abs(range.low), std::abs(range.high), threshold * shown.field.info.unit.per_inside});
    range.low = -most;
    range.high = most;
    range.note += ", even about 0";
    return range;
}

void draw(const DiffOptions& options, const ComparedRun& a, const ClSurface& surface, const DrawnDifference& shown,
          double threshold, PictureOutput& output) {
    const viz::MapPanel panel{&surface, &shown.field, "", {}, {}, {}};
    const viz::Camera camera = viz::map_camera({panel}, options.look.look);
    const ShownRange range = range_of(shown, surface, options.look, threshold);
    viz::MapTexts texts;
    texts.title =
        fmt::format("{}: {} minus {}", shown.field.info.label, file_name(shown.run), file_name(options.files.front()));
    texts.subtitle =
        fmt::format("{} points of {}, {} path", a.path.count, file_name(options.files.front()), name_of(a.path.role));
    texts.notes = notes_of(range);
    const viz::Image image =
        viz::draw_map({panel}, camera, scale_of(shown.field.info, range, options.look), texts, options.look.look);
    output.write(image, fmt::format("clsurf difference of {} and {}: {} {:g} to {:g} {}", file_name(shown.run),
                                    file_name(options.files.front()), shown.field.info.name, range.low, range.high,
                                    shown.field.info.unit.name));
}

bool lines_known(const LoadedRun& run, const RunOptions& options) {
    return run.log.find("line") != nullptr || run.simulated || !options.program.empty();
}

void write_result(const io::ReportedRuns& reported, const Diagnostics& diagnostics, bool json,
                  const po::variables_map& values) {
    if (json) return write_to_stdout(io::runs_json(reported));
    print(diagnostics, values);
    write_answer(io::runs_text(reported), values);
}

/// No runs yet. Both must outlive it.
io::ReportedRuns reported_against(const LoadedRun& reference, const Diagnostics& diagnostics) {
    io::ReportedRuns reported;
    reported.reference = reference.name;
    reported.diagnostics = &diagnostics;
    return reported;
}

ExitCode run_diff(const po::variables_map& values) {
    const DiffOptions options = read_diff_options(values);
    std::optional<PictureOutput> output;
    if (!options.output.empty()) output.emplace(options.output);
    StageClock clock(read_common(values), 3 + 2 * static_cast<int>(options.files.size()));
    Diagnostics diagnostics;
    clock.begin("read the reference");
    LoadedRun reference = load_run(options.files.front(), options.runs);
    diagnostics.append(reference.log.diagnostics);
    io::ReportedRuns reported = reported_against(reference, diagnostics);

    std::unique_ptr<LineMap> lines;
    ClSurface surface;
    std::unique_ptr<DriftFinder> drift;
    std::optional<CuttingTool> tool;
    ComparedRun a;
    std::optional<DrawnDifference> shown;
    double threshold = 0;
    for (std::size_t k = 1; k < options.files.size(); ++k) {
        clock.begin("read a run");
        const LoadedRun loaded = load_run(options.files[k], options.runs);
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
        clock.begin("compare the runs");
        RunDifferences differences = compare_runs(a, surface, b);
        require_alignment(differences, reference.name, loaded.name);
        RunReport report =
            report_run(a, surface, lines_known(reference, options.runs) ? lines.get() : nullptr, b, differences);
        if (tool) PartContacts(reference.log, a.path, *lines, surface, *tool).locate(report);
        std::vector<BudgetLine> budget = hold(report, options.budget);
        reported.runs.push_back({loaded.name, std::move(report), std::move(budget)});
        drift->add(differences);
        if (output && !shown) {
            threshold = differences.threshold[index_of(options.shown)];
            shown = drawn(differences, options.shown, loaded.name);
        }
    }
    reported.departures = drift->departures();
    reported.drifted = drifted_run(reported.departures);
    if (output) {
        clock.begin("draw");
        draw(options, a, surface, *shown, threshold, *output);
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
        .summary = "runs of a part against each other, by path: where speed, acceleration, lag and height differ",
        .description =
            "Lays runs onto the first one by path, not by time, so that feed override, pauses, other sampling periods and logs that begin in\n"
            "the middle do no harm, and says where speed, acceleration, lag along the feed and height differ: B minus A. Each is a log, or a\n"
            "program, which is simulated. With a budget, exit code 1 says that it was not held. Of three runs and more the one that departs\n"
            "from the others is named. The map shows the first B.\n\n"
            "  clsurf diff monday.biip friday.biip --program part.nc\n"
            "  clsurf diff monday.biip friday.biip --budget runs.toml -o difference.png --color height\n"
            "  clsurf diff part.nc part_smoothed.nc --machine mill.toml",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("budget", po::value<std::string>()->value_name("FILE"), "limits as TOML; exit code 1 where one is not held")
                    ("output,o", po::value<std::string>()->value_name("FILE"), "a map of the differences: .png, .jpg, .tif or .webp")
                    ("color", po::value<std::string>()->value_name("speed|acceleration|lag|height"), "which difference the map shows (default: speed)");
                // clang-format on
                declare_json(options);
                declare_runs(options);
                declare_look(options);
            },
        .positional = {"A", "B…"},
        .run = run_diff,
    };
}

}  // namespace clsurf::cli
