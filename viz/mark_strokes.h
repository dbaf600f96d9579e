#pragma once
// Sections of passes as bands in the picture: as wide as their strips of the part are seen, so that they stay on it.

#include <vector>

#include "core/point.h"
#include "viz/depth_buffer.h"
#include "viz/map_panel.h"

namespace clsurf::viz {

/// A band in the picture by its two edges, point by point [px].
struct Band {
    std::vector<Vec2> left, right;

    [[nodiscard]] std::size_t size() const { return left.size(); }
    [[nodiscard]] Vec2 centre(std::size_t k) const { return 0.5 * (left[k] + right[k]); }
    [[nodiscard]] std::vector<Vec2> centre_line() const;
};

/// Of even width about a straight line.
[[nodiscard]] Band band_of(const Vec2& from, const Vec2& to, double width);
/// Along its middle [px].
[[nodiscard]] double length_of(const Band& band);
/// From one length along its middle to another.
[[nodiscard]] Band part_of(const Band& band, double from, double to);
/// Of a share of the width.
[[nodiscard]] Band narrowed(const Band& band, double share);

/// Whether a place [px] lies on it.
[[nodiscard]] bool covers(const Band& band, const Vec2& at);

/// A section of a pass in the picture, all of it seen or all of it hidden.
struct Stroke {
    Band band;
    bool hidden = false;
};

/// What lies in the picture of a section: from half way to the one adjacent pass to half way to the other, or the pass itself
/// where the surface ends there; but at least `least_size` wide and long [px]. `corner`: of the panel.
[[nodiscard]] std::vector<Stroke> strokes_of(const ClSurface& surface, const PointRange& section, const Camera& camera,
                                             const Vec2& corner, const Look& look, const DepthBuffer& depth,
                                             double least_size);

}  // namespace clsurf::viz
