#pragma once
// Sections of passes as bands in the picture, with the projected width of their strips, so that they stay on the part.

#include <vector>

#include "core/point.h"
#include "viz/depth_buffer.h"
#include "viz/map_panel.h"

namespace clsurf::viz {

/// A band in the picture, given by its two edges, point by point [px].
struct Band {
    std::vector<Vec2> left, right;

    [[nodiscard]] std::size_t size() const { return left.size(); }
    [[nodiscard]] Vec2 centre(std::size_t k) const { return 0.5 * (left[k] + right[k]); }
    [[nodiscard]] std::vector<Vec2> centre_line() const;
};

/// A band of constant width along a straight line.
[[nodiscard]] Band band_of(const Vec2& from, const Vec2& to, double width);
/// Length along its middle [px].
[[nodiscard]] double length_of(const Band& band);
/// The band between two lengths along its middle.
[[nodiscard]] Band part_of(const Band& band, double from, double to);
/// The same band with a share of its width.
[[nodiscard]] Band narrowed(const Band& band, double share);

/// Whether a point [px] is on it.
[[nodiscard]] bool covers(const Band& band, const Vec2& at);

/// A section of a pass in the picture, completely visible or completely hidden.
struct Stroke {
    Band band;
    bool hidden = false;
};

/// The visible part of a section: from halfway to one adjacent pass to halfway to the other, or to the pass itself
/// if the surface ends there; at least `least_size` wide and long [px]. `corner`: of the panel.
[[nodiscard]] std::vector<Stroke> strokes_of(const ClSurface& surface, const PointRange& section, const Camera& camera,
                                             const Vec2& corner, const Look& look, const DepthBuffer& depth,
                                             double least_size);

}  // namespace clsurf::viz
