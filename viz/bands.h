#pragma once
// Bands: triangles between adjacent passes, over vertices selected along the path. They use every vertex, so
// that there are no cracks. Seams fill the gaps of bands: turns, ends of passes, corners, the start of a loop. The gap of
// a missing pass stays open. Pictures select vertices by pixels (detail.h), pages by the detail that they need
// (io/page/kept_points.h).

#include <array>
#include <cstdint>
#include <span>

#include "surface/cl_surface.h"

namespace clsurf::viz {

/// Points of a surface in path order.
struct SectionVertices {
    Column<PointIndex> points;
    Column<std::uint8_t> joined;  ///< 1: connected to the previous vertex
    Column<std::uint8_t> links;   ///< 1: on a link between passes
};

/// The passes, with the sideways moves between closed loops as separate links. Bands end at links, so that the speed
/// of such a move is not drawn into the adjacent passes.
[[nodiscard]] Passes sections_of_path(const ClSurface& surface);

/// One vertex per point; `points` increase. Points of rapids are not connected. Domain: the ends of
/// all passes and links are among them.
[[nodiscard]] SectionVertices section_vertices(const ClSurface& surface, std::span<const PointIndex> points);

struct Bands {
    Column<std::uint32_t> triangles;  ///< 3 vertex numbers each
    Column<std::uint32_t> segments;   ///< 2 each: of passes without an adjacent one
};

/// The frame in which distances are measured: linear · position of the surface + shift.
struct NearnessFrame {
    Eigen::Matrix3f linear = Eigen::Matrix3f::Identity();
    Eigen::Vector3f shift = Eigen::Vector3f::Zero();
};

/// Each point is represented by the previous or next vertex, whichever is closer in `frame`; by none if both are farther
/// than `reach`. O(vertices), parallel.
[[nodiscard]] Bands join_passes(const ClSurface& surface, const SectionVertices& vertices, const NearnessFrame& frame,
                                float reach);

/// The same in three parts: cells made at vertices before `first`, from `first` to before `end`, and from `end` on.
[[nodiscard]] std::array<Bands, 3> join_passes(const ClSurface& surface, const SectionVertices& vertices,
                                               const NearnessFrame& frame, float reach, std::int64_t first,
                                               std::int64_t end);

/// The triangles between adjacent passes over all points, 3 points each. O(points), parallel.
[[nodiscard]] Column<std::int64_t> triangles_of(const ClSurface& surface);

}  // namespace clsurf::viz
