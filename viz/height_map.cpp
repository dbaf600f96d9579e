#include "viz/height_map.h"

#include <cmath>
#include <limits>

namespace clsurf::viz {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// The slope from the vertices on both sides, or on one side if there is only one.
float slope(const HeightMap& map, std::int64_t i, std::int64_t at, std::int64_t count, std::int64_t stride) {
    const auto z = [&](std::int64_t k) { return map.z[static_cast<std::size_t>(k)]; };
    const bool before = at > 0 && z(i - stride) == z(i - stride);
    const bool after = at + 1 < count && z(i + stride) == z(i + stride);
    if (!before && !after) return 0;
    const float rise = (after ? z(i + stride) : z(i)) - (before ? z(i - stride) : z(i));
    return rise / static_cast<float>(map.pitch * (before && after ? 2 : 1));
}

}  // namespace

Box3 extent_of(const HeightMap& map, const Eigen::Matrix3d& axes) {
    Box3 box;
    for (std::int64_t i = 0; i < map.columns * map.rows; ++i) {
        if (map.z[static_cast<std::size_t>(i)] == map.z[static_cast<std::size_t>(i)])
            box.extend(Vec3(axes * map.at(i)));
    }
    return box;
}

Detail height_map_detail(const HeightMap& map, std::span<const float> values, const DetailRequest& request) {
    Detail detail;
    Geometry& g = detail.geometry;
    g.origin = map.origin;
    const std::int64_t count = map.columns * map.rows;
    std::vector<std::uint32_t> vertex(static_cast<std::size_t>(count), none);
    for (std::int64_t i = 0; i < count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (!(map.z[k] == map.z[k])) continue;
        const Vec3 p = map.at(i);
        if (!request.box.isEmpty() && !request.box.contains(p)) continue;
        const Eigen::Vector2d pixel = request.projection * p.homogeneous();
        if (!(pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= request.width && pixel.y() <= request.height)) continue;
        vertex[k] = static_cast<std::uint32_t>(detail.values.size());
        const Vec3 off = p - map.origin;
        const std::int64_t column = i % map.columns;
        const std::int64_t row = i / map.columns;
        const Eigen::Vector3f normal =
            Eigen::Vector3f(-slope(map, i, column, map.columns, 1), -slope(map, i, row, map.rows, map.columns), 1)
                .normalized();
        for (int axis = 0; axis < 3; ++axis) {
            g.xyz.push_back(static_cast<float>(off[axis]));
            g.normals.push_back(normal[axis]);
        }
        detail.values.push_back(values[k]);
        detail.points.push_back(i);
    }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (request.style != Style::surface || a == none || b == none || c == none) return;
        for (const std::uint32_t v : {a, b, c}) g.triangles.push_back(v);
    };
    for (std::int64_t row = 0; row + 1 < map.rows; ++row) {
        for (std::int64_t column = 0; column + 1 < map.columns; ++column) {
            const auto k = static_cast<std::size_t>(row * map.columns + column);
            const auto up = k + static_cast<std::size_t>(map.columns);
            add(vertex[k], vertex[k + 1], vertex[up + 1]);
            add(vertex[k], vertex[up + 1], vertex[up]);
        }
    }
    return detail;
}

}  // namespace clsurf::viz
