#pragma once
// MapLayout: the sizes of what stands on a map's sheet, from the picture's size, and its inks.

#include "viz/scene.h"

namespace clsurf::viz {

/// [px]
struct MapLayout {
    double text, small_text, margin, title_height, note_height, legend_width;
    explicit MapLayout(const Look& look);
};

/// What is read on a background.
[[nodiscard]] Rgb ink_for(const Rgb& background);
[[nodiscard]] Rgb faint(const Rgb& ink, const Rgb& background);

}  // namespace clsurf::viz
