#pragma once
// DefectCard: one defect on a third of a page: its position, and the curves that show it.

#include <array>
#include <string>
#include <vector>

#include "core/geometry.h"
#include "viz/canvas.h"

namespace clsurf::viz {

struct CardCurve {
    std::vector<double> values;  ///< one per x; NaN: a gap
    Rgb rgb{0, 0, 0};
    double width = 1.5;  ///< [px] width at a height of 600
};

struct CardChart {
    std::string title, x_label;
    std::vector<double> x;
    std::vector<CardCurve> curves;            ///< the last on top
    std::vector<double> band_low, band_high;  ///< the usual range, per x; empty: no band
    double marked_from = 0, marked_to = 0;    ///< the defective section; equal: none
    std::vector<double> ticks;                ///< small ticks at x, where program lines begin
    std::vector<std::pair<double, std::string>> tick_labels;
    bool dots = false;  ///< a dot at each value
};

struct CardKey {
    std::string name;
    Rgb rgb{0, 0, 0};
};

/// The orientation of a card's map: its scale, and directions in the picture (to the right, up), with their projected
/// lengths.
struct CardBearings {
    double mm_per_pixel = 0;   ///< 0: not known
    Vec2 feed = Vec2::Zero();  ///< direction of the defective pass; zero: not known
    std::array<Vec2, 3> axes{Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};  ///< X, Y, Z of the part
};

struct DefectCard {
    std::string title, subtitle;
    Image map;  ///< at the left, above its scale, the direction of feed, and axes
    CardBearings bearings;
    std::vector<CardKey> key;
    std::string band_name;          ///< "usual ± threshold"
    std::vector<CardChart> charts;  ///< the first over the full width, the others next to each other below it
};

/// The size of the map for a card of a given size [px].
struct CardMapSize {
    int width = 0, height = 0;
};
[[nodiscard]] CardMapSize card_map_size(int width, int height);

/// Draws a card, and its drawing if the map has one. Domain: the map has the size of card_map_size(). Throws SystemError.
[[nodiscard]] Image draw_card(const DefectCard& card, int width, int height, const std::string& gl);

}  // namespace clsurf::viz
