#pragma once
// MapLayout: the sizes of the items on the sheet of a map, from the size of the picture, and its inks.

#include "viz/map_panel.h"

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
