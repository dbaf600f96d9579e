#pragma once
// Drawing: a picture as lines and texts over its rendered surfaces, for SVG and PDF.

#include <vector>

#include "core/column.h"
#include "viz/flat.h"

namespace clsurf::viz {

/// All positions are in pixels of the finished picture, from its lower left corner.
struct Drawing {
    /// The rendered surfaces without flat items, in the resolution of rendering, which is finer than the picture.
    struct Ground {
        int width = 0, height = 0;  ///< [px] of this image
        Column<std::uint8_t> rgb;   ///< rows from the top
        Rect place;
    };
    int width = 0, height = 0;  ///< [px]
    Rgb background{255, 255, 255};
    std::vector<Ground> grounds;
    std::vector<FlatQuad> quads;
    std::vector<FlatLine> lines;  ///< from bottom to top
    std::vector<FlatText> texts;
    std::vector<double> text_widths;  ///< [px] width of each text
};

/// Adds the content of another drawing with its lower left corner at (x, y).
void add(Drawing& onto, const Drawing& other, double x, double y);

}  // namespace clsurf::viz
