// clsurf check: adjacent-path discontinuities and the marks that they will leave.

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "cli/part.h"
#include "cli/quality.h"
#include "cli/report_output.h"
#include "field/range.h"
#include "io/budget_file.h"
#include "io/quality_report.h"
#include "viz/colour_difference.h"

namespace clsurf::cli {
namespace {

constexpr const char* check_formats = "text|json|csv|sarif";

using QualityWriter = std::string (*)(const io::ReportedQuality&);

QualityWriter writer_of(const std::string& format) {
    static const std::map<std::string, QualityWriter, std::less<>> writers{
        {"text", io::quality_text}, {"json", io::quality_json}, {"csv", io::quality_csv}, {"sarif", io::quality_sarif}};
    return writers.at(format);
}

/// How different a defect and the passes beside it look in the map that `render` draws by default.
std::vector<double> colour_differences(const QualityReport& report, const Part& part, const ClSurface& surface) {
    std::vector<double> differences;
    if (report.defects.empty()) return differences;
    const Field speed = FieldSet(part.log, part.path, surface.passes).get("speed");
    const ShownRange range = find_range(speed, surface.passes, {}, {});
    const viz::ColourScale scale{viz::make_colour_map("isurface"), range.low, range.high, 0};
    const auto look = [&](double mm_s) { return viz::lab_of(scale.colour(mm_s * speed.info.unit.per_inside)); };
    for (const Defect& defect : report.defects)
        differences.push_back(viz::delta_e00(look(defect.speed), look(defect.speed_beside)));
    return differences;
}

ExitCode run_check(const po::variables_map& values) {
    PartOptions options = read_part_options(values);
    const std::optional<Role> measured = take_measured_role(options);
    QualityBudget budget;
    if (values.count("budget") > 0) budget = io::read_budget(values["budget"].as<std::string>());
    ReportOutput output(values, check_formats);
    const QualityWriter write = writer_of(output.format());

    StageClock clock(read_common(values), 8);
    Part part = load_part(options, clock);
    clock.begin("stitch the surface");
    const ClSurface surface = stitch(part);
    const Quality quality = judge(part, surface, measured, {}, clock);

    io::ReportedQuality reported;
    reported.report = &quality.report;
    reported.program = &part.program;
    reported.log = part.log.name;
    reported.tool = part.tool;
    reported.scallop = quality.scallop;
    if (output.format() == "json") reported.colour_differences = colour_differences(quality.report, part, surface);
    reported.formed = quality.formed ? &*quality.formed : nullptr;
    reported.budget = hold(quality.report, budget);
    reported.diagnostics = &part.diagnostics;
    clock.end();
    if (output.format() != "json") print(part.diagnostics, values);
    output.write(write(reported));
    // No verdict comes before a failed one: numbers that mean nothing meet no budget and miss none.
    if (!quality.report.judgement.judged()) return ExitCode::not_judged;
    return all_held(reported.budget) ? ExitCode::done : ExitCode::check_failed;
}

}  // namespace

Subcommand check_subcommand() {
    return {
        .name = "check",
        .arguments = "PROGRAM LOG",
        .summary = "adjacent-path discontinuities and predicted marks, with lines, causes and micrometres",
        .description =
            "Compares every pass with its neighbours: speed, acceleration, and where the axes run off the commanded\n"
            "path. Begins with a verdict, and lists what differs enough to leave a mark, what stands out most first,\n"
            "with the lines at fault and the predicted depth. Severity: 1 trace (in the data, hardly on the part),\n"
            "2 visible (on a polished or glossy surface), 3 distinct (on any finished surface), 4 reject (too deep to\n"
            "polish out). A speed below that of the neighbours is negative; depths have no sign but a shape, pit or\n"
            "bulge. Exits with 1 if a limit of --budget is exceeded, and with 5 if the data do not allow a verdict:\n"
            "less than half of the cutting points could be compared, for example.\n\n"
            "  clsurf check part.nc run.biip --tool ball:6\n"
            "  clsurf check part.nc run.biip --tool ball:6 --budget part.toml --format sarif -o part.sarif",
        .declare =
            [](po::options_description& options) {
                declare_tool(options);
                // clang-format off
                options.add_options()
                    ("budget", po::value<std::string>()->value_name("FILE"), "limits as TOML; exit code 1 where one is not held");
                // clang-format on
                declare_report_output(options, check_formats);
                declare_part(options);
            },
        .positional = {"PROGRAM", "LOG"},
        .run = run_check,
    };
}

}  // namespace clsurf::cli
