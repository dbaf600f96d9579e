#include "viz/map_layout.h"

#include <algorithm>

namespace clsurf::viz {
namespace {

/// The names are the result of a defect map: they must be readable if the picture is one column of a page.
double text_size(const Look& look, Arrangement arrangement) {
    const double usual = std::min(look.width * 0.75, look.height * 1.0) / (look.names ? 36.0 : 46.0);
    // Such a picture has room next to or below the part.
    const double roomy = std::min(look.width, look.height) / 40.0;
    return std::clamp(arrangement == Arrangement::usual ? usual : std::max(usual, roomy), 9.0, 60.0);
}

}  // namespace

MapLayout::MapLayout(const Look& look, Arrangement arranged)
    : arrangement(arranged),
      text(text_size(look, arranged)),
      small_text(std::max(8.0, 0.78 * text)),
      margin(0.8 * text),
      title_height((arranged == Arrangement::tall ? 5.2 : 3.6) * text),
      note_height(3.0 * small_text),
      legend_width(!look.legend ? 0
                   : look.names ? 15.0 * text
                                : 7.2 * text) {
    if (arranged == Arrangement::wide) title_width = std::clamp(0.2 * look.width, 16.0 * text, 26.0 * text);
    if (arranged == Arrangement::tall) legend_height = (look.names ? 14.0 : 6.5) * text;
}

Rect MapLayout::map_area(const Look& look) const {
    Rect area{0, 0, look.width - legend_width, static_cast<double>(look.height)};
    if (!look.legend) return area;
    if (arrangement == Arrangement::wide)
        return {title_width, margin, look.width - legend_width - title_width, look.height - 2 * margin};
    area.y = note_height + legend_height;
    area.height -= area.y + title_height;
    if (arrangement == Arrangement::tall) area.width = look.width;
    return area;
}

bool is_wide(const Look& look) {
    constexpr double wide_picture = 1.9;  // width over height
    return look.width > wide_picture * look.height;
}

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
