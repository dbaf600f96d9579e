#pragma once
// Words that maps have in common.

#include <string>
#include <vector>

#include "field/range.h"
#include "surface/cl_surface.h"

namespace clsurf::viz {

/// "27517 points, 42 passes, 0.5 mm apart".
[[nodiscard]] std::string counts_of(const ClSurface& surface);
/// What the footnote says of a range.
[[nodiscard]] std::vector<std::string> notes_of(const ShownRange& range);

}  // namespace clsurf::viz
