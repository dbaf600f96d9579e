#pragma once
// The picture of `check --measured`: the measured profile over the predicted one, and their difference.

#include "cli/picture_output.h"
#include "io/reports/reported_measurement.h"
#include "pipeline/part.h"

namespace clsurf::cli {

/// Of an areal map the profile in its middle. Domain: something was compared.
void draw_measured(const io::ReportedMeasurement& measured, const Part& part, const CuttingTool& tool,
                   PictureOutput& output);

}  // namespace clsurf::cli
