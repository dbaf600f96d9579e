#include "viz/symbol.h"

#include <algorithm>
#include <cmath>

namespace clsurf::viz {

void add_symbol(Sheet& sheet, const Vec2& at, SymbolShape shape, double radius, const Rgb& rgb, Level level) {
    constexpr int strips = 14;
    for (int k = 0; k < strips; ++k) {
        const double v = 2 * (k + 0.5) / strips - 1;
        double half = std::sqrt(std::max(0.0, 1 - v * v));
        if (shape == SymbolShape::diamond) half = 1.15 * (1 - std::abs(v));
        if (shape == SymbolShape::square) half = 0.85;
        if (shape == SymbolShape::triangle) half = 0.5 * (1 - v) * 1.2;
        const Vec2 middle = at + Vec2(0, v * radius);
        sheet.lines.push_back({{middle - Vec2(half * radius, 0), middle + Vec2(half * radius, 0)},
                               2 * radius / strips + 0.3,
                               rgb,
                               level});
    }
}

}  // namespace clsurf::viz
