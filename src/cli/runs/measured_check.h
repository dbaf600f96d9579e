#pragma once
// `check --measured`: compares a measurement of the part with the prediction.

#include <memory>
#include <string>

#include "cli/options/measured_options.h"
#include "cli/pictures/picture_output.h"
#include "cli/runs/checked_run.h"
#include "cli/stage_clock.h"
#include "io/reports/reported_measurement.h"

namespace clsurf::cli {

/// A measurement of the part, and the picture of the comparison.
struct MeasuredInput {
    Measurement measurement;
    std::unique_ptr<PictureOutput> picture;  ///< nullptr: not requested
};

/// --measured, --picture, and the options for reading and aligning a measurement.
void declare_measured_check(po::options_description& options);

/// nullptr: no measurement is given. `format`: of the report. Throws UsageError: --picture and others without --measured, a
/// report format that cannot contain it, several logs; InputError: the file cannot be read.
[[nodiscard]] std::unique_ptr<MeasuredInput> read_measured_input(const po::variables_map& values,
                                                                 const std::string& format, std::size_t logs);

/// Aligns a measurement of a part with the predicted surface of `role` (none: the most truthful positions), and compares.
/// `report` has the predicted marks. Throws UsageError: the tool is not known; InputError: no adjacent passes.
[[nodiscard]] io::ReportedMeasurement compare_measured(const Part& part, const ClSurface& surface,
                                                       const QualityReport& report, std::optional<Role> role,
                                                       Measurement measurement, StageClock& clock);

/// The same for a run; also draws the picture, or warns that it is not drawn. Moves the data out of `input`.
[[nodiscard]] io::ReportedMeasurement compare_measured(CheckedRun& run, std::optional<Role> role, MeasuredInput& input,
                                                       StageClock& clock);

}  // namespace clsurf::cli
