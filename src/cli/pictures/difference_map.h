#pragma once
// The map of `diff`: the difference of one quantity on the surface of the reference.

#include <string>

#include "cli/options/look.h"
#include "cli/pictures/picture_output.h"
#include "compare/run_difference.h"
#include "field/field.h"
#include "surface/cl_surface.h"

namespace clsurf::cli {

/// "speed", "acceleration", "lag" or "height", of --color. Throws UsageError.
[[nodiscard]] RunQuantity parse_quantity(const std::string& text);

/// One quantity, and the names of the runs.
struct DrawnDifference {
    Field field;
    std::string reference, run;
    std::string note{};  ///< below the map
};

/// Moves the values of a quantity out of `differences`. Throws UsageError: the runs do not have it.
[[nodiscard]] DrawnDifference drawn_difference(RunDifferences& differences, RunQuantity quantity);

/// `path`: of the reference.
void draw_difference(const DrawnDifference& shown, const Trajectory& path, const ClSurface& surface,
                     const LookOptions& look, PictureOutput& output);

}  // namespace clsurf::cli
