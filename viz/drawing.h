#pragma once
// Drawing: a picture as lines and texts over the pixels of its surfaces, for SVG and PDF.

#include <vector>

#include "core/column.h"
#include "viz/flat.h"

namespace clsurf::viz {

/// All places in pixels of the finished picture, from its lower left corner.
struct Drawing {
    /// A surface, without anything flat: as fine as it was drawn, which is finer than the picture.
    struct Ground {
        int width = 0, height = 0;  ///< [px] of its own
        Column<std::uint8_t> rgb;   ///< rows from the top
        Rect place;
    };
    int width = 0, height = 0;  ///< [px]
    Rgb background{255, 255, 255};
    std::vector<Ground> grounds;
    std::vector<FlatQuad> quads;
    std::vector<FlatLine> lines;  ///< the lowest first
    std::vector<FlatText> texts;
    std::vector<double> text_widths;  ///< [px] of each text
};

/// Puts everything of another one on it, with its lower left corner at a place.
void add(Drawing& onto, const Drawing& other, double x, double y);

}  // namespace clsurf::viz
