#pragma once
// The picture of `optimize`.

#include <string>

#include "repair/optimizer.h"
#include "viz/image.h"

namespace clsurf::cli {

/// Both runs next to each other: speeds, and below them the differences between adjacent passes, each on one scale.
/// `program`: its name, for the title. `keep_drawing`: for SVG and PDF.
[[nodiscard]] viz::Image draw_before_and_after(const Optimized& result, const std::string& program, bool keep_drawing);

}  // namespace clsurf::cli
