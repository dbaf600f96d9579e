#pragma once
// MapLayout: the sizes of the items on the sheet of a map, from the size of the picture, and its inks.

#include "viz/map_panel.h"

namespace clsurf::viz {

/// Where the words of a map stand: title above the part and legend at its right; title in a column at the left of a wide
/// picture, whose height is the part's then; legend below the part in a tall picture, whose width is the part's then.
enum class Arrangement : std::uint8_t { usual, wide, tall };

/// [px]
struct MapLayout {
    Arrangement arrangement;
    double text, small_text, margin, title_height, note_height, legend_width;
    double title_width = 0;    ///< of the column of a wide picture
    double legend_height = 0;  ///< the least below the part in a tall picture

    explicit MapLayout(const Look& look, Arrangement arranged = Arrangement::usual);
    /// What is left for panels and their scales.
    [[nodiscard]] Rect map_area(const Look& look) const;
};

/// What is read on a background.
[[nodiscard]] Rgb ink_for(const Rgb& background);
[[nodiscard]] Rgb faint(const Rgb& ink, const Rgb& background);

}  // namespace clsurf::viz
