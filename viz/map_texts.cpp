#include "viz/map_texts.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "viz/colour_map.h"

namespace clsurf::viz {

namespace {

std::string counts_of(const ClSurface& surface, const std::string& points) {
    PointIndex passes = 0;
    for (const Pass& pass : surface.passes) passes += pass.kind == PassKind::cut ? 1 : 0;
    return fmt::format("{} points, {} {}{}", points, passes, passes == 1 ? "pass" : "passes",
                       surface.step_over > 0 ? fmt::format(", {:.3g} mm apart", surface.step_over) : "");
}

}  // namespace

std::string counts_of(const ClSurface& surface) {
    return counts_of(surface, fmt::format("{}", surface.positions.size()));
}

std::string counts_of_selection(const ClSurface& surface) {
    PointIndex shown = 0;
    for (const Pass& piece : surface.passes) shown += is_of_surface(piece.kind) ? piece.last - piece.first + 1 : 0;
    return counts_of(surface, fmt::format("{} of {}", shown, surface.positions.size()));
}

std::vector<std::string> notes_of(const ShownRange& range) {
    std::vector<std::string> notes{range.note};
    if (range.lowest < range.low || range.highest > range.high) {
        const double readable = std::max(1e-3 * (range.high - range.low), 1e-6 * std::abs(range.high));
        notes.push_back(
            fmt::format("values from {} to {}", tick_text(range.lowest, readable), tick_text(range.highest, readable)));
    }
    return notes;
}

}  // namespace clsurf::viz
