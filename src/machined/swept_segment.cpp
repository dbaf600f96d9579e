#include "machined/swept_segment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/vectorised.h"

namespace clsurf {
namespace {

/// Columns of a row that lie in the strip, last exclusive.
struct Columns {
    int first, last;
};

/// Where low ≤ a + b x ≤ high holds, taken off `from` … `to`.
inline void narrow(float a, float b, float low, float high, float& from, float& to) {
    if (b == 0.0F) {
        if (a < low || a > high) to = from - 1;
        return;
    }
    const float p = (low - a) / b;
    const float q = (high - a) / b;
    from = std::max(from, std::min(p, q));
    to = std::min(to, std::max(p, q));
}

/// A row seen from the segment: along = s + dx x, across = w − dy x.
struct Row {
    float s, w;
    Columns columns;
};

inline Row row_of(const SweptSegment& g, const CellBlock& cells, int row) {
    const float y = static_cast<float>(row) * cells.cell - g.y;
    Row r{-g.x * g.dx + y * g.dy, g.x * g.dy + y * g.dx, {0, 0}};
    float from = 0;
    float to = static_cast<float>(cells.columns - 1) * cells.cell;
    narrow(r.s, g.dx, g.along_low, g.along_high, from, to);
    narrow(r.w, -g.dy, g.across_low, g.across_high, from, to);
    if (from <= to) {
        constexpr float rounding = 0.01F;  // of a cell: the last column must not be lost to it
        r.columns.first = static_cast<int>(std::ceil(from / cells.cell - rounding));
        r.columns.last = std::min(cells.columns, static_cast<int>(std::floor(to / cells.cell + rounding)) + 1);
    }
    return r;
}

/// Rows that the strip can touch.
Columns rows_of(const SweptSegment& g, const CellBlock& cells) {
    const float a = g.dy * g.along_low;
    const float b = g.dy * g.along_high;
    const float c = g.dx * g.across_low;
    const float d = g.dx * g.across_high;
    const float low = g.y + std::min(a, b) + std::min(c, d);
    const float high = g.y + std::max(a, b) + std::max(c, d);
    const auto last = static_cast<float>(cells.rows);
    return {static_cast<int>(std::clamp(std::floor(low / cells.cell), 0.0F, last)),
            static_cast<int>(std::clamp(std::floor(high / cells.cell) + 1, 0.0F, last))};
}

/// One row under a ball: the loop that all the time goes into.
CLSURF_VECTORISED void lower_row(float* z, int count, float s, float ds, float w, float dw, float radius, float sine,
                                 float slope, float length, float tip) {
    const float squared = radius * radius;
    for (int k = 0; k < count; ++k) {
        const auto x = static_cast<float>(k);
        const float along = s + ds * x;
        const float across = w + dw * x;
        const float rest = squared - across * across;
        const float half = std::sqrt(rest > 0 ? rest : 0.0F);
        // The tangent of slope touches the circle of this section `half · sine` from its middle.
        float at = along - half * sine;
        at = at < 0 ? 0.0F : at;
        at = at > length ? length : at;
        const float off = along - at;
        const float q = rest - off * off;
        const float height = tip + slope * at + (radius - std::sqrt(q > 0 ? q : 0.0F));
        const float lowered = height < z[k] ? height : z[k];
        z[k] = q >= 0 ? lowered : z[k];
    }
}

void lower_ball(float radius, const SweptSegment& g, const CellBlock& cells) {
    const float sine = g.slope / std::sqrt(1 + g.slope * g.slope);
    const Columns rows = rows_of(g, cells);
    for (int row = rows.first; row < rows.last; ++row) {
        const Row r = row_of(g, cells, row);
        if (r.columns.first >= r.columns.last) continue;
        const float x = static_cast<float>(r.columns.first) * cells.cell;
        lower_row(cells.z + static_cast<std::ptrdiff_t>(row) * cells.columns + r.columns.first,
                  r.columns.last - r.columns.first, r.s + g.dx * x, g.dx * cells.cell, r.w - g.dy * x,
                  -g.dy * cells.cell, radius, sine, g.slope, g.length, g.z);
    }
}

constexpr int intervals = 32;  ///< of a bull-nose tool's table across the segment

/// For a bull-nose tool: how far before the axis its sections, `low` + k `step` beside the axis, are touched
/// by a tangent of this slope; by halving, since the slope of a section rises all the way.
CLSURF_VECTORISED void touched_before(float* before, float low, float step, float radius, float corner, float slope) {
    const float bottom = radius - corner;
    float inner[intervals + 1];
    float outer[intervals + 1];
    for (int k = 0; k <= intervals; ++k) {
        const float across = low + static_cast<float>(k) * step;
        const float from = bottom * bottom - across * across;
        const float to = radius * radius - across * across;
        inner[k] = std::sqrt(from > 0 ? from : 0.0F);
        outer[k] = std::sqrt(to > 0 ? to : 0.0F);
    }
    constexpr int halvings = 20;
    for (int n = 0; n < halvings; ++n) {
        for (int k = 0; k <= intervals; ++k) {
            const float across = low + static_cast<float>(k) * step;
            const float u = 0.5F * (inner[k] + outer[k]);
            const float rho = std::sqrt(u * u + across * across);
            const float out = rho - bottom;
            const float up = corner * corner - out * out;
            const bool steeper = (up <= 0) | (out * u > std::abs(slope) * rho * std::sqrt(up > 0 ? up : 0.0F));
            outer[k] = steeper ? u : outer[k];
            inner[k] = steeper ? inner[k] : u;
        }
    }
    const float sign = slope > 0 ? 0.5F : slope < 0 ? -0.5F : 0.0F;
    for (int k = 0; k <= intervals; ++k) before[k] = sign * (inner[k] + outer[k]);
}

/// The same for all places across: it depends on nothing else. Linear between the places of a table.
struct Touched {
    float low = 0, per_mm = 1;
    std::array<float, intervals + 1> before{};

    Touched(const CuttingTool& tool, const SweptSegment& g)
        : low(std::max(g.across_low, static_cast<float>(-tool.radius))) {
        const float high = std::min(g.across_high, static_cast<float>(tool.radius));
        const float step = std::max(high - low, 1e-6F) / intervals;
        per_mm = 1 / step;
        touched_before(before.data(), low, step, static_cast<float>(tool.radius), static_cast<float>(tool.corner),
                       g.slope);
    }
};

/// `lower(along, across, z)` for every cell in reach: its place in the frame of the segment, mm.
template <typename Lower>
void lower_cells(const SweptSegment& g, const CellBlock& cells, Lower&& lower) {
    const Columns rows = rows_of(g, cells);
    for (int row = rows.first; row < rows.last; ++row) {
        const Row r = row_of(g, cells, row);
        float* const z = cells.z + static_cast<std::ptrdiff_t>(row) * cells.columns;
        for (int column = r.columns.first; column < r.columns.last; ++column) {
            const float x = static_cast<float>(column) * cells.cell;
            lower(r.s + g.dx * x, r.w - g.dy * x, z[column]);
        }
    }
}

/// One row under a bull-nose tool.
CLSURF_VECTORISED void lower_bull_row(float* z, int count, float s, float ds, float w, float dw, float radius,
                                      float corner, const Touched& touched, float slope, float length, float tip) {
    const float bottom = radius - corner;
    const float* const before = touched.before.data();
    const float low = touched.low;
    const float per_mm = touched.per_mm;
    for (int k = 0; k < count; ++k) {
        const auto x = static_cast<float>(k);
        const float along = s + ds * x;
        const float across = w + dw * x;
        float place = (across - low) * per_mm;
        place = place < 0 ? 0.0F : place;
        place = place > intervals - 0.001F ? intervals - 0.001F : place;
        const int left = static_cast<int>(place);
        const float share = place - static_cast<float>(left);
        float at = along - (before[left] + share * (before[left + 1] - before[left]));
        at = at < 0 ? 0.0F : at;
        at = at > length ? length : at;
        const float off = along - at;
        const float rho = std::sqrt(off * off + across * across);
        const float out = rho - bottom > 0 ? rho - bottom : 0.0F;
        const float up = corner * corner - out * out;
        const float height = tip + slope * at + (corner - std::sqrt(up > 0 ? up : 0.0F));
        const float lowered = height < z[k] ? height : z[k];
        z[k] = rho <= radius ? lowered : z[k];
    }
}

void lower_bull(const CuttingTool& tool, const SweptSegment& g, const CellBlock& cells) {
    const Columns rows = rows_of(g, cells);
    std::optional<Touched> touched;
    for (int row = rows.first; row < rows.last; ++row) {
        const Row r = row_of(g, cells, row);
        if (r.columns.first >= r.columns.last) continue;
        if (!touched) touched.emplace(tool, g);  // many segments lie beside the cells
        const float x = static_cast<float>(r.columns.first) * cells.cell;
        lower_bull_row(cells.z + static_cast<std::ptrdiff_t>(row) * cells.columns + r.columns.first,
                       r.columns.last - r.columns.first, r.s + g.dx * x, g.dx * cells.cell, r.w - g.dy * x,
                       -g.dy * cells.cell, static_cast<float>(tool.radius), static_cast<float>(tool.corner), *touched,
                       g.slope, g.length, g.z);
    }
}

void lower_flat(const CuttingTool& tool, const SweptSegment& g, const CellBlock& cells) {
    const auto radius = static_cast<float>(tool.radius);
    lower_cells(g, cells, [&](float along, float across, float& z) {
        const float rest = radius * radius - across * across;
        if (rest < 0) return;
        const float half = std::sqrt(rest);
        const float first = std::max(0.0F, along - half);
        const float last = std::min(g.length, along + half);
        // The bottom stands over the cell all the way between: the lower end counts.
        if (first <= last) z = std::min(z, g.z + g.slope * (g.slope >= 0 ? first : last));
    });
}

}  // namespace

void lower(const CuttingTool& tool, const SweptSegment& segment, const CellBlock& cells) {
    switch (tool.kind) {
        case ToolKind::ball: return lower_ball(static_cast<float>(tool.radius), segment, cells);
        case ToolKind::bull: return lower_bull(tool, segment, cells);
        case ToolKind::flat: return lower_flat(tool, segment, cells);
    }
}

}  // namespace clsurf
