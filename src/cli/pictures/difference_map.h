#pragma once
// The map that `diff` draws: one quantity's difference on the surface of the reference.

#include <string>

#include "cli/options/look.h"
#include "cli/pictures/picture_output.h"
#include "compare/run_difference.h"
#include "field/field.h"
#include "surface/cl_surface.h"

namespace clsurf::cli {

/// "speed", "acceleration", "lag" or "height", of --color. Throws UsageError.
[[nodiscard]] RunQuantity parse_quantity(const std::string& text);

/// One quantity, and what the runs are called.
struct DrawnDifference {
    Field field;
    std::string reference, run;
    std::string note{};  ///< below the map
};

/// Takes the values of a quantity out of `differences`. Throws UsageError: the runs do not have it.
[[nodiscard]] DrawnDifference drawn_difference(RunDifferences& differences, RunQuantity quantity);

/// `path`: of the reference, whose surface that is.
void draw_difference(const DrawnDifference& shown, const Trajectory& path, const ClSurface& surface,
                     const LookOptions& look, PictureOutput& output);

}  // namespace clsurf::cli
