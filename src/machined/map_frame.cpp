#include "machined/map_frame.h"

#include <cmath>

namespace clsurf {

Box2 MapFrame::bounds(std::int64_t column, std::int64_t row, std::int64_t wide, std::int64_t high) const {
    Box2 box;
    for (const std::int64_t c : {column, column + wide - 1}) {
        for (const std::int64_t r : {row, row + high - 1})
            box.extend(at(static_cast<double>(c), static_cast<double>(r)));
    }
    return box;
}

MapFrame frame_of(const Box2& box, double cell) {
    MapFrame frame;
    if (box.isEmpty()) return frame;
    frame.corner = box.min();
    frame.cell = cell;
    frame.columns = static_cast<std::int64_t>(std::floor(box.sizes().x() / cell)) + 1;
    frame.rows = static_cast<std::int64_t>(std::floor(box.sizes().y() / cell)) + 1;
    return frame;
}

}  // namespace clsurf
