#pragma once
// The picture of `optimize`.

#include <string>

#include "repair/optimizer.h"
#include "viz/image.h"

namespace clsurf::cli {

/// Both runs side by side: speeds, and below them the differences between adjacent passes, each on one scale. `program`: its name, for the title.
[[nodiscard]] viz::Image draw_before_and_after(const Optimized& result, const std::string& program);

}  // namespace clsurf::cli
