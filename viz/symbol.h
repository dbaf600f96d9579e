#pragma once
// Symbols of charts, composed of strips, because lines have square ends.

#include <cstddef>

#include "viz/canvas.h"

namespace clsurf::viz {

enum class SymbolShape : std::uint8_t { disc, diamond, square, triangle };

/// `radius` of the disc [px]; the other symbols appear equally large.
void add_symbol(Sheet& sheet, const Vec2& at, SymbolShape shape, double radius, const Rgb& rgb,
                Level level = Level::dot);

}  // namespace clsurf::viz
