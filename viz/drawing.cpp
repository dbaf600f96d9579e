#include "viz/drawing.h"

#include <utility>

namespace clsurf::viz {

void add(Drawing& onto, const Drawing& other, double x, double y) {
    for (Drawing::Ground ground : other.grounds) {
        ground.place.x += x;
        ground.place.y += y;
        onto.grounds.push_back(std::move(ground));
    }
    for (FlatQuad quad : other.quads) {
        quad.rect.x += x;
        quad.rect.y += y;
        onto.quads.push_back(quad);
    }
    for (FlatLine line : other.lines) {
        for (Vec2& point : line.points) point += Vec2(x, y);
        for (Vec2& point : line.opposite) point += Vec2(x, y);
        if (line.clip) {
            line.clip->x += x;
            line.clip->y += y;
        }
        onto.lines.push_back(std::move(line));
    }
    for (FlatText text : other.texts) {
        text.x += x;
        text.y += y;
        onto.texts.push_back(std::move(text));
    }
    onto.text_widths.insert(onto.text_widths.end(), other.text_widths.begin(), other.text_widths.end());
}

}  // namespace clsurf::viz
