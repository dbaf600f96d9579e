#pragma once
// MapLayout: the sizes of the items on the sheet of a map, derived from the size of the picture, and its text colours.

#include "viz/map_panel.h"

namespace clsurf::viz {

/// The layout of title and legend. `usual`: title above the part, legend at its right. `wide`: title in a column at the left,
/// so that the part has the full height. `tall`: legend below the part, so that the part has the full width.
/// so that the part has the full height. `tall`: legend below the part, so that the part has the full width.
enum class Arrangement : std::uint8_t { usual, wide, tall };

/// [px]
struct MapLayout {
    Arrangement arrangement;
    double text, small_text, margin;
    double title_height;  ///< height of one line and the subtitle; in a tall picture of two lines and the subtitle
    double note_height, legend_width;
    double title_width = 0;    ///< width of the column of a wide picture
    double legend_height = 0;  ///< least height below the part in a tall picture

    explicit MapLayout(const Look& look, Arrangement arranged = Arrangement::usual);
    /// The rectangle for the panels and their scales, without title, notes and legend.
    [[nodiscard]] Rect map_area(const Look& look) const;
};

/// Whether the picture is wide enough for a title next to the part.
[[nodiscard]] bool is_wide(const Look& look);

/// A text colour that is readable on a background.
[[nodiscard]] Rgb ink_for(const Rgb& background);
[[nodiscard]] Rgb faint(const Rgb& ink, const Rgb& background);

}  // namespace clsurf::viz
