#pragma once
// The picture of `identify`: where the simulated speed differs from the log along the path.

#include <span>

#include "cli/pictures/picture_output.h"
#include "identify/identification.h"
#include "pipeline/part.h"

namespace clsurf::cli {

/// Draws the run with the largest speed error, of the test runs if there are any, otherwise of the runs of the fit. Throws
/// InputError: no run can be simulated.
void draw_speed_residual(const Identification& result, std::span<const Part> parts, std::span<const Part> tests,
                         PictureOutput& output);

}  // namespace clsurf::cli
