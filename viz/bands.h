#pragma once
// Bands: triangles between adjacent passes, over vertices selected along the path. They use every vertex, so
// no cracks open. Seams fill the gaps of bands: turns, ends of passes, corners, the start of a loop. A missing
// pass stays open. Pixels determine what is drawn (detail.h); required detail determines what a page gets
// (io/page/kept_points.h).

#include <array>
#include <cstdint>
#include <span>

#include "surface/cl_surface.h"

namespace clsurf::viz {

/// Points of a surface in their order.
struct SectionVertices {
    Column<PointIndex> points;
    Column<std::uint8_t> joined;  ///< 1: goes on from the vertex before
    Column<std::uint8_t> links;   ///< 1: on the way from one pass to the next
};

/// The passes with the steps sideways between closed loops as links of their own: bands end there, so that how
/// fast such a step was made is not drawn into the adjacent passes.
[[nodiscard]] Passes sections_of_path(const ClSurface& surface);

/// The vertices of points, rising: one each; those of rapids are joined to nothing. Domain: the ends of
/// all passes and links are among them.
[[nodiscard]] SectionVertices section_vertices(const ClSurface& surface, std::span<const PointIndex> points);

struct Bands {
    Column<std::uint32_t> triangles;  ///< 3 vertex numbers each
    Column<std::uint32_t> segments;   ///< 2 each: where a pass has no other beside it
};

/// Where nearness is measured: a position of the surface → linear · position + shift.
struct NearnessFrame {
    Eigen::Matrix3f linear = Eigen::Matrix3f::Identity();
    Eigen::Vector3f shift = Eigen::Vector3f::Zero();
};

/// A point is stood for by the vertex before or after it, whichever is nearer in `frame`; by none that is farther
/// than `reach` there. O(vertices), parallel.
[[nodiscard]] Bands join_passes(const ClSurface& surface, const SectionVertices& vertices, const NearnessFrame& frame,
                                float reach);

/// The same in three: what is made at vertices before `first`, from there to before `end`, and from `end` on.
[[nodiscard]] std::array<Bands, 3> join_passes(const ClSurface& surface, const SectionVertices& vertices,
                                               const NearnessFrame& frame, float reach, std::int64_t first,
                                               std::int64_t end);

/// The triangles between adjacent passes over all points, 3 points each. O(points), parallel.
[[nodiscard]] Column<std::int64_t> triangles_of(const ClSurface& surface);

}  // namespace clsurf::viz
