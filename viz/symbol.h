#pragma once
// Symbols of charts, made of strips: a line's width has square ends.

#include <cstddef>

#include "viz/canvas.h"

namespace clsurf::viz {

enum class SymbolShape : std::uint8_t { disc, diamond, square, triangle };

/// `radius`: of the disc [px]; the others look as large.
void add_symbol(Sheet& sheet, const Vec2& at, SymbolShape shape, double radius, const Rgb& rgb,
                Level level = Level::dot);

}  // namespace clsurf::viz
