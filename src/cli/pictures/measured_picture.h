#pragma once
// The picture of `check --measured` and `report --measured`: the measured profile over the predicted one, and their difference.

#include <string>

#include "io/reports/reported_measurement.h"
#include "pipeline/part.h"
#include "viz/image.h"

namespace clsurf::cli {

/// A chart with its title.
struct MeasuredPicture {
    viz::Image image;
    std::string title;
};

/// For an areal map the profile in its middle. `keep_drawing`: as PictureOutput::wants_drawing(). Domain: the comparison
/// is not empty.
[[nodiscard]] MeasuredPicture draw_measured(const io::ReportedMeasurement& measured, const Part& part,
                                            const CuttingTool& tool, bool keep_drawing = false);

}  // namespace clsurf::cli
