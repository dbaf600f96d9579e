#pragma once
// `check --measured`: what was measured on the part, next to the prediction.

#include <memory>
#include <string>

#include "cli/options/measured_options.h"
#include "cli/pictures/picture_output.h"
#include "cli/runs/checked_run.h"
#include "cli/stage_clock.h"
#include "io/reports/reported_measurement.h"

namespace clsurf::cli {

/// What was measured on the part, and the picture of the comparison.
struct MeasuredInput {
    Measurement measurement;
    std::unique_ptr<PictureOutput> picture;  ///< nullptr: not asked for
};

/// --measured, --picture, and how a measurement is read and aligned.
void declare_measured_check(po::options_description& options);

/// nullptr: nothing was measured. `format`: of the report. Throws UsageError: --picture and others without --measured, a form of
/// report that cannot hold it, several logs; InputError: the file cannot be read.
[[nodiscard]] std::unique_ptr<MeasuredInput> read_measured_input(const po::variables_map& values,
                                                                 const std::string& format, std::size_t logs);

/// Aligns what was measured on a part with the surface that `role` (none: the most truthful positions) predicts, and compares.
/// `report` has the predicted marks. Throws UsageError: the tool is not known; InputError: no adjacent passes.
[[nodiscard]] io::ReportedMeasurement compare_measured(const Part& part, const ClSurface& surface,
                                                       const QualityReport& report, std::optional<Role> role,
                                                       Measurement measurement, StageClock& clock);

/// The same of a run, and draws the picture, or adds a warning that it is not drawn. Takes the data out of `input`.
[[nodiscard]] io::ReportedMeasurement compare_measured(CheckedRun& run, std::optional<Role> role, MeasuredInput& input,
                                                       StageClock& clock);

}  // namespace clsurf::cli
