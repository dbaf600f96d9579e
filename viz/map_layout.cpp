#include "viz/map_layout.h"

#include <algorithm>

namespace clsurf::viz {

// Names are the answer of a defect map: they are to be read where the picture is one column of a page.
MapLayout::MapLayout(const Look& look)
    : text(std::clamp(std::min(look.width * 0.75, look.height * 1.0) / (look.names ? 36.0 : 46.0), 9.0, 60.0)),
      small_text(std::max(8.0, 0.78 * text)),
      margin(0.8 * text),
      title_height(3.6 * text),
      note_height(3.0 * small_text),
      legend_width(!look.legend ? 0
                   : look.names ? 15.0 * text
                                : 7.2 * text) {}

Rgb ink_for(const Rgb& background) {
    const double lightness = 0.3 * background[0] + 0.59 * background[1] + 0.11 * background[2];
    return lightness > 128 ? Rgb{20, 20, 24} : Rgb{240, 240, 240};
}

Rgb faint(const Rgb& ink, const Rgb& background) {
    Rgb mixed;
    for (std::size_t k = 0; k < 3; ++k) mixed[k] = static_cast<std::uint8_t>((2 * ink[k] + background[k]) / 3);
    return mixed;
}

}  // namespace clsurf::viz
