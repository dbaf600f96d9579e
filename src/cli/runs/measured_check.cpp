#include "cli/runs/measured_check.h"

#include <utility>

#include <fmt/format.h>

#include "cli/options/measured_options.h"
#include "cli/pictures/measured_picture.h"
#include "core/error.h"
#include "pipeline/as_machined_part.h"

namespace clsurf::cli {

void declare_measured_check(po::options_description& options) {
    declare_measured_file(options);
    // clang-format off
    options.add_options()
        ("picture", po::value<std::string>()->value_name("FILE"), "with --measured: the measured profile over the predicted one, and their difference (.png, .jpg, .tif, .webp, .svg or .pdf)");
    // clang-format on
    declare_measured(options);
}

std::unique_ptr<MeasuredInput> read_measured_input(const po::variables_map& values, const std::string& format,
                                                   std::size_t logs) {
    if (values.count("measured") == 0) {
        const char* alone = given(values, "picture") ? "picture" : given_measured_option(values);
        if (alone != nullptr) throw UsageError(fmt::format("--{} needs --measured", alone));
        return nullptr;
    }
    if (logs > 1) throw UsageError("--measured accepts one log: one measurement belongs to one run");
    if (format != "text" && format != "json")
        throw UsageError(fmt::format("--measured is reported as text and JSON, not as {}", format));
    auto input = std::make_unique<MeasuredInput>();
    input->measurement = read_measurement(values);
    if (values.count("picture") > 0)
        input->picture =
            std::make_unique<PictureOutput>(values["picture"].as<std::string>(), "--picture", PictureKind::drawing);
    return input;
}

io::ReportedMeasurement compare_measured(const Part& part, const ClSurface& surface, const QualityReport& report,
                                         std::optional<Role> role, Measurement measurement, StageClock& clock) {
    const CuttingTool tool = required_tool(part, "--measured", "--measured stylus.csv --tool ball:6");
    if (surface.step_over <= 0)
        throw InputError(Place::of_file(part.log.name), "has no adjacent passes: there is no surface to align with");
    clock.begin("compare with the measurement");
    const AsMachinedPart as_machined(part, surface, role, tool, &report);
    io::ReportedMeasurement measured{std::move(measurement.data), {}};
    measured.result =
        compare_with_measured(measured.data, as_machined.surface(), as_machined.signals(), report, measurement.rules);
    clock.end();
    return measured;
}

io::ReportedMeasurement compare_measured(CheckedRun& run, std::optional<Role> role, MeasuredInput& input,
                                         StageClock& clock) {
    io::ReportedMeasurement measured =
        compare_measured(run.part, run.surface, run.quality.report, role, std::move(input.measurement), clock);
    warn_of_misfit(measured.data, measured.result.alignment, run.part.diagnostics);
    const std::string& reason = measured.result.comparison.reason;
    if (input.picture && reason.empty()) {
        const MeasuredPicture picture =
            draw_measured(measured, run.part, *run.part.tool, input.picture->wants_drawing());
        input.picture->write(picture.image, picture.title);
    }
    if (input.picture && !reason.empty())
        run.part.diagnostics.add({Severity::warning,
                                  "measured.no-picture",
                                  Place::of_file(measured.data.name),
                                  "no picture is drawn: " + reason,
                                  {}});
    return measured;
}

}  // namespace clsurf::cli
