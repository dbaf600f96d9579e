// clsurf align: the pose of measured points on the predicted surface.

#include "cli/options/measured_options.h"
#include "cli/options/options.h"
#include "cli/options/part.h"
#include "cli/stage_clock.h"
#include "io/reports/alignment_report.h"
#include "measured/measured_result.h"
#include "pipeline/as_machined_part.h"

namespace clsurf::cli {
namespace {

ExitCode run_align(const po::variables_map& values) {
    const std::string points = required(values, "POINTS");
    const bool json = read_json(values);
    const MeasuredOptions measured = read_measured_options(values);
    PartOptions options = read_part_options(values);
    const std::optional<Role> role = take_measured_role(options);
    const MeasuredData data = io::read_measured(points, measured.columns);
    StageClock clock(read_common(values), 7);
    Part part = load_part(options, clock);
    const CuttingTool tool = required_tool(part, "align", "--tool ball:6");
    clock.begin("stitch the surface");
    const ClSurface surface = stitch(part);
    if (surface.step_over <= 0)
        throw InputError(Place::of_file(part.log.name), "has no adjacent passes: there is no surface to align with");
    clock.begin("sweep the tool");
    const AsMachinedPart as_machined(part, surface, role, tool);
    clock.begin("align");
    const Alignment alignment =
        align_by_roughness(data, as_machined.surface(), as_machined.signals(), measured.rules).alignment;
    clock.end();
    warn_of_misfit(data, alignment, part.diagnostics);
    if (json) {
        write_to_stdout(io::alignment_json(data, alignment, tool, part.diagnostics));
    } else {
        print(part.diagnostics, values);
        write_answer(io::alignment_text(data, alignment), values);
    }
    return alignment.determined() ? ExitCode::done : ExitCode::not_judged;
}

}  // namespace

Subcommand align_subcommand() {
    return {
        .name = "align",
        .arguments = "POINTS PROGRAM LOG",
        .summary = "finds the pose of measured points on the predicted surface",
        .description =
            "POINTS is what was measured on the finished part: a profile (x, z) or points of a coordinate measuring machine\n"
            "(x, y, z) as delimited text, or an areal map as a surface data file (ISO 25178-71, .sdf). The fit is a least-squares\n"
            "fit: it minimises the distances along the normal from the points to the surface that the tool leaves along the\n"
            "positions of the log. Each fitted value has a standard error. The first fit starts from the stated start and uses\n"
            "the form alone. Poses near its result are compared next, because a surface with scallops fits nearly as well when\n"
            "it is displaced by one step-over.\n"
            "The exit code is 5 if the data do not determine the pose. The message gives the reason, for example: a plane can be\n"
            "shifted in itself; the start of a profile is not given; two poses fit equally well, because there is no mark or form;\n"
            "the roughness differs from that of the place, so the start is wrong.\n\n"
            "  clsurf align cmm.csv part.nc run.biip --tool ball:6\n"
            "  clsurf align stylus.csv part.nc run.biip --tool ball:6 --measured-at 12.5,3,90",
        .declare =
            [](po::options_description& options) {
                declare_tool(
                    options,
                    "the tool, diameter and corner radius in mm (default: from the log's metadata or --tools)");
                declare_measured(options);
                declare_part(options);
                declare_json(options);
            },
        .positional = {"POINTS", "PROGRAM", "LOG"},
        .run = run_align,
    };
}

}  // namespace clsurf::cli
