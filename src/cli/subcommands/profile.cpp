// clsurf profile: a tool path from scanned points.

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "cli/options/options.h"
#include "cli/options/output_format.h"
#include "cli/pictures/picture_output.h"
#include "cli/pictures/profile_picture.h"
#include "cli/programs/planned_cut.h"
#include "cli/programs/profile_options.h"
#include "cli/programs/simulated_cut.h"
#include "core/file_name.h"
#include "io/readers/machine_file.h"
#include "io/readers/program_file.h"
#include "io/reports/cut_report.h"
#include "scan/cut_program.h"

namespace clsurf::cli {
namespace {

/// The program, read back as from its file.
Program read_written(const std::string& name, const std::string& text, const std::string& dialect) {
    const auto kept = std::make_shared<const std::string>(text);
    const io::Source source{name, std::as_bytes(std::span(kept->data(), kept->size())), kept};
    io::ProgramOptions options;
    options.dialect = dialect;
    return io::read_program(source, options);
}

std::string program_of(const ScanCut& cut, const ProfileOptions& options, const MeasuredData& data, double plane) {
    const auto highest = std::max_element(cut.path.samples().begin(), cut.path.samples().end(),
                                          [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); });
    const std::string name = file_name(data.name);
    const CutProgramRules rules{options.dialect, name, options.feed, std::ceil(highest->y() + options.clearance),
                                plane};
    return options.splines ? span_program(cut.path.spans(), rules) : line_program(cut.path.points(), rules);
}

/// Warns if the fit rounds off features of the scan: its residuals are larger than scatter explains.
void warn_of_misfit(const MeasuredData& data, const ScanCut& cut, double tolerance, Diagnostics& diagnostics) {
    constexpr double far_above_tolerance = 10, above_scatter = 3, above_rms = 6;
    const double worst = cut.residuals.worst, rms = cut.residuals.rms;
    const bool more_than_scatter = worst > above_rms * rms || rms > above_scatter * cut.scan.scatter;
    if (!(worst > far_above_tolerance * tolerance && more_than_scatter)) return;
    diagnostics.add(
        {Severity::warning, "profile.misfit", Place::of_file(data.name),
         fmt::format("the fit is {:.4f} mm away from a scanned point, at X {:.6g} mm: {:.0f} times the tolerance",
                     worst, cut.residuals.worst_x, worst / tolerance),
         "a shorter --window follows more; a step in the part is rounded off by any"});
}

ExitCode run_profile(const po::variables_map& values) {
    const std::string scan = required(values, "SCAN");
    const std::string path = required(values, "output");
    const bool json = read_json_with_output(values);
    const ProfileOptions options = read_profile_options(values);
    require_program_ending(path);
    const MeasuredData data = io::read_measured(scan, options.columns);
    io::AtomicFile output(path);
    std::optional<PictureOutput> picture;
    if (values.count("picture") > 0)
        picture.emplace(values["picture"].as<std::string>(), "--picture", PictureKind::drawing);
    PlannedCut planned = planned_cut(data, options);
    const ScanCut& cut = planned.cut;
    const std::string text = program_of(cut, options, data, planned.plane);
    Program program = read_written(path, text, options.dialect);
    const ReadBack written = read_back(program, cut.path);
    const Machine machine =
        values.count("machine") > 0 ? io::read_machine(values["machine"].as<std::string>()) : Machine{};
    io::CutReport report{data.name,       path,
                         options.dialect, data.points.size(),
                         data.missing,    options.cut,
                         written,         simulated_cut(program, cut, options.cut.tolerance, machine),
                         options.splines, std::move(planned.corrected)};
    const double rounding = std::pow(10.0, -cut_decimals);
    if (report.written.deviation > options.cut.tolerance + rounding)
        throw InputError(
            Place::of_file(data.name),
            fmt::format("the program would be {:.4f} mm away from the fit, beyond the tolerance: it is not written",
                        report.written.deviation));
    if (!report.corrected) warn_of_misfit(data, cut, options.cut.tolerance, program.diagnostics);
    if (picture) draw_fit(report, cut, *picture);
    output.write(text);
    output.commit();
    if (json) {
        write_to_stdout(io::cut_json(report, cut, program.diagnostics));
    } else {
        print(program.diagnostics, values);
        write_answer(io::cut_text(report, cut), values);
    }
    return ExitCode::done;
}

}  // namespace

Subcommand profile_subcommand() {
    return {
        .name = "profile",
        .arguments = "SCAN -o cut.nc",
        .summary = "writes a program that follows scanned points",
        .description =
            "SCAN has points along X, as delimited text (comma, semicolon, tab or blanks): x and z in mm, or in the unit that\n"
            "follows the column's name, as in z [µm]. Outliers are rejected. Polynomials are fitted to windows of points, by\n"
            "least squares, and joined. The program has lines or splines that stay within the tolerance of the fit, in the XZ\n"
            "plane. It is read again, simulated on --machine, and compared with the fit before the file appears. Add tool,\n"
            "spindle and work offset yourself.\n\n"
            "The window decides what is form and what is noise: a long one is smooth and misses short waves. --picture shows\n"
            "the residuals.\n\n"
            "With --tool-offset the tool is a ball-end tool that cuts the fitted profile. If it would cut too deep, because the profile\n"
            "curves more tightly than the ball, the message says where, and no program is written.\n\n"
            "With --compensate SCAN has deviations that were measured along a finished pass, such as x and dz [µm]. Where\n"
            "the part is too high, the corrected pass cuts deeper at the point that the ball touches.\n\n"
            "  clsurf profile scan.csv -o cut.ngc\n"
            "  clsurf profile scan.csv --window 30 --tool-offset 3 --picture fit.png -o cut.ngc\n"
            "  clsurf profile laser.txt --x 0 --z 2 --distance 120 --sensor-offset 35 --dialect siemens --blocks splines -o cut.mpf\n"
            "  clsurf profile deviations.csv --z dz --compensate cut.ngc --tool-offset 3 -o corrected.ngc",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("output,o", po::value<std::string>()->value_name("FILE"), "the NC program")
                    ("picture", po::value<std::string>()->value_name("FILE"), "fit and residuals as a picture");
                // clang-format on
                declare_profile_options(options);
                // clang-format off
                options.add_options()
                    ("machine", po::value<std::string>()->value_name("FILE"), "machine file of the simulation that verifies the program (default: that of clsurf machine --defaults)");
                // clang-format on
                declare_json(options);
            },
        .positional = {"SCAN"},
        .run = run_profile,
    };
}

}  // namespace clsurf::cli
