#pragma once
// Words that maps have in common.

#include <string>
#include <vector>

#include "field/range.h"
#include "surface/cl_surface.h"

namespace clsurf::viz {

/// "27517 points, 42 passes, 0.5 mm apart".
[[nodiscard]] std::string counts_of(const ClSurface& surface);
/// The same of a surface of which a part was selected (surface/selection.h): "61 of 18531 points, 1 pass, …".
[[nodiscard]] std::string counts_of_selection(const ClSurface& surface);
/// What the footnote says of a range.
[[nodiscard]] std::vector<std::string> notes_of(const ShownRange& range);

}  // namespace clsurf::viz
