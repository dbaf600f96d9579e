#include "viz/detail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <vector>

#include "core/parallel.h"
#include "viz/bands.h"

namespace clsurf::viz {
namespace {

using Vec2f = Eigen::Vector2f;
using Vec3f = Eigen::Vector3f;

constexpr PointIndex part_points = 65536;
constexpr float reach_steps = 6;  ///< largest distance from a point to the vertex that represents it, in steps
constexpr float margin = 4.0F;    ///< [px] kept around the picture

/// Vertices of a part of a pass, and the mean over the points of each.
struct Vertices : SectionVertices {
    Column<float> values;
};

class Projector {
public:
    Projector(const ClSurface& surface, const DetailRequest& request)
        : p_(surface.positions),
          width_(static_cast<float>(request.width)),
          height_(static_cast<float>(request.height)),
          boxed_(!request.box.isEmpty()) {
        linear_ = request.projection.leftCols<3>().cast<float>();
        const Vec2 shift = request.projection.leftCols<3>() * p_.origin + request.projection.col(3);
        shift_ = shift.cast<float>();
        if (boxed_) {
            low_ = (request.box.min() - p_.origin).cast<float>();
            high_ = (request.box.max() - p_.origin).cast<float>();
        }
    }
    [[nodiscard]] Vec2f pixel(PointIndex i) const { return linear_ * p_[i] + shift_; }
    /// The first two rows are pixels.
    [[nodiscard]] NearnessFrame frame() const {
        NearnessFrame frame;
        frame.linear << linear_, Eigen::RowVector3f::Zero();
        frame.shift << shift_, 0;
        return frame;
    }
    [[nodiscard]] bool visible(PointIndex i, const Vec2f& at) const {
        const bool inside =
            at.x() > -margin && at.x() < width_ + margin && at.y() > -margin && at.y() < height_ + margin;
        if (!inside || !boxed_) return inside;
        const Vec3f q = p_[i];
        return (q.array() >= low_.array()).all() && (q.array() <= high_.array()).all();
    }

private:
    const Positions& p_;
    float width_, height_;
    Eigen::Matrix<float, 2, 3> linear_;
    Vec2f shift_;
    bool boxed_;
    Vec3f low_, high_;
};

struct Part {
    PointIndex first = 0, last = -1;
    bool starts_pass = true;
    bool link = false;
};

/// Passes and links in parts, in order.
std::vector<Part> parts_of(const Passes& passes) {
    std::vector<Part> parts;
    for (std::size_t k = 0; k < passes.size(); ++k) {
        const Pass& pass = passes[k];
        if (!is_of_surface(pass.kind)) continue;
        // Consecutive pieces of one run (pass, link, the next turn of a spiral) are connected.
        const bool continues = k > 0 && is_of_surface(passes[k - 1].kind);
        for (PointIndex first = pass.first; first <= pass.last; first += part_points) {
            parts.push_back({first, std::min(pass.last, first + part_points - 1), first == pass.first && !continues,
                             pass.kind == PassKind::link});
        }
    }
    return parts;
}

/// Merges the points of a part into vertices.
void gather_vertices(const Projector& projector, const Part& part, std::span<const float> values, float step,
                     Vertices& out) {
    const float step_squared = step * step;
    bool joins = !part.starts_pass;
    PointIndex begin = part.first;
    while (begin <= part.last) {
        const Vec2f start = projector.pixel(begin);
        if (!projector.visible(begin, start)) {
            joins = false;
            ++begin;
            continue;
        }
        double sum = 0;
        std::int64_t known = 0;
        PointIndex end = begin;
        for (; end <= part.last; ++end) {
            if ((projector.pixel(end) - start).squaredNorm() > step_squared) break;
            const float value = values[static_cast<std::size_t>(end)];
            if (value == value) {
                sum += value;
                ++known;
            }
        }
        // The ends of a part are vertices, so that consecutive parts meet.
        const PointIndex middle = begin == part.first ? begin : end > part.last ? part.last : begin + (end - begin) / 2;
        out.points.push_back(middle);
        out.values.push_back(known > 0 ? static_cast<float>(sum / static_cast<double>(known))
                                       : std::numeric_limits<float>::quiet_NaN());
        out.joined.push_back(joins ? 1 : 0);
        out.links.push_back(part.link ? 1 : 0);
        joins = true;
        begin = std::max(end, begin + 1);
    }
}

void put_positions(const Positions& positions, const Column<PointIndex>& points, Geometry& geometry) {
    geometry.origin = positions.origin;
    geometry.xyz.resize(points.size() * 3);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec3f p = positions[points[k]];
        for (int axis = 0; axis < 3; ++axis) geometry.xyz[3 * k + static_cast<std::size_t>(axis)] = p[axis];
    }
}

/// Vertex normals: the sum of the triangles' normals, weighted by area, turned to z > 0. On a
/// vertical wall the sign is not changed. On a three-axis machine the tool comes from above.
void put_normals(Geometry& geometry, std::initializer_list<std::span<const std::uint32_t>> triangles) {
    geometry.normals = Column<float>(geometry.xyz.size(), 0.0F);
    const auto at = [](Column<float>& column, std::uint32_t v) {
        return Eigen::Map<Vec3f>(column.data() + std::size_t{3} * v);
    };
    for (const std::span<const std::uint32_t> some : triangles) {
        for (std::size_t t = 0; t + 2 < some.size(); t += 3) {
            const std::uint32_t a = some[t], b = some[t + 1], c = some[t + 2];
            const Vec3f pa = at(geometry.xyz, a);
            Vec3f n = (at(geometry.xyz, b) - pa).cross(at(geometry.xyz, c) - pa);
            if (n.z() < 0) n = -n;
            at(geometry.normals, a) += n;
            at(geometry.normals, b) += n;
            at(geometry.normals, c) += n;
        }
    }
    for (std::size_t v = 0; v < geometry.xyz.size() / 3; ++v) {
        auto n = at(geometry.normals, static_cast<std::uint32_t>(v));
        const float length = n.norm();
        n = length > 0 ? Vec3f(n / length) : Vec3f(Vec3f::UnitZ());
    }
}

}  // namespace

Detail visible_detail(const ClSurface& surface, std::span<const float> values, const DetailRequest& request) {
    const Projector projector(surface, request);
    const auto step = static_cast<float>(request.vertex_step);
    const std::vector<Part> parts = parts_of(sections_of_path(surface));
    std::vector<Vertices> of_part(parts.size());
    parallel_for(static_cast<std::int64_t>(parts.size()), 1, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) {
            const auto at = static_cast<std::size_t>(k);
            gather_vertices(projector, parts[at], values, step, of_part[at]);
        }
    });
    Vertices all;
    for (const Vertices& part : of_part) {
        append(all.points, part.points);
        append(all.values, part.values);
        append(all.joined, part.joined);
        append(all.links, part.links);
    }
    of_part.clear();

    Detail detail;
    Geometry& geometry = detail.geometry;
    put_positions(surface.positions, all.points, geometry);
    const auto vertex_at = [&](auto bound) { return bound - all.points.begin(); };
    const std::int64_t first = vertex_at(std::lower_bound(all.points.begin(), all.points.end(), request.own.first));
    const std::int64_t end = vertex_at(std::upper_bound(all.points.begin(), all.points.end(), request.own.last));
    if (request.style == Style::surface) {
        std::array<Bands, 3> bands = join_passes(surface, all, projector.frame(), reach_steps * step, first, end);
        put_normals(geometry, {bands[0].triangles, bands[1].triangles, bands[2].triangles});
        geometry.triangles = std::move(bands[1].triangles);
        geometry.segments = std::move(bands[1].segments);
    } else if (request.style == Style::lines) {
        for (std::int64_t v = first; v < end; ++v) {
            if (all.joined[static_cast<std::size_t>(v)] == 0) continue;
            geometry.segments.push_back(static_cast<std::uint32_t>(v - 1));
            geometry.segments.push_back(static_cast<std::uint32_t>(v));
        }
    } else {
        for (std::int64_t v = first; v < end; ++v) geometry.points.push_back(static_cast<std::uint32_t>(v));
    }
    detail.values = std::move(all.values);
    detail.points = std::move(all.points);
    return detail;
}

}  // namespace clsurf::viz
