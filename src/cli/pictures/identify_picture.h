#pragma once
// The picture of `identify`: where along the path the simulation with the machine found runs at another speed than the log.

#include <span>

#include "cli/pictures/picture_output.h"
#include "identify/identification.h"
#include "pipeline/part.h"

namespace clsurf::cli {

/// Of the run with the greatest speed error: of the test runs, where there are some, else of the runs of the fit. Throws
/// InputError: no run can be simulated.
void draw_speed_residual(const Identification& result, std::span<const Part> parts, std::span<const Part> tests,
                         PictureOutput& output);

}  // namespace clsurf::cli
