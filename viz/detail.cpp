#include "viz/detail.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/parallel.h"

namespace clsurf::viz {
namespace {

using Vec2f = Eigen::Vector2f;
using Vec3f = Eigen::Vector3f;

constexpr PointIndex part_points = 65536;
constexpr float margin = 4.0F;          ///< [px] round the picture that is kept
constexpr int longest_turn = 512;          ///< vertices from a link to where its passes see each other
constexpr std::int64_t longest_fan = 256;  ///< vertices of a neighbour that one step may span

/// Vertices of a part of a pass.
struct Vertices {
    Column<PointIndex> points;
    Column<float> values;
    Column<std::uint8_t> joined;  ///< 1: goes on from the vertex before
};

class Projector {
public:
    Projector(const ClSurface& surface, const DetailRequest& request)
        : p_(surface.positions), width_(static_cast<float>(request.width)), height_(static_cast<float>(request.height)) {
        linear_ = request.projection.leftCols<3>().cast<float>();
        const Vec2 shift = request.projection.leftCols<3>() * p_.origin + request.projection.col(3);
        shift_ = shift.cast<float>();
        boxed_ = !request.box.isEmpty();
        if (boxed_) {
            low_ = (request.box.min() - p_.origin).cast<float>();
            high_ = (request.box.max() - p_.origin).cast<float>();
        }
    }
    [[nodiscard]] Vec2f pixel(PointIndex i) const { return linear_ * p_[i] + shift_; }
    [[nodiscard]] bool visible(PointIndex i, const Vec2f& at) const {
        const bool inside = at.x() > -margin && at.x() < width_ + margin && at.y() > -margin &&
                            at.y() < height_ + margin;
        if (!inside || !boxed_) return inside;
        const Vec3f q = p_[i];
        return (q.array() >= low_.array()).all() && (q.array() <= high_.array()).all();
    }

private:
    const Positions& p_;
    float width_, height_;
    Eigen::Matrix<float, 2, 3> linear_;
    Vec2f shift_;
    bool boxed_ = false;
    Vec3f low_, high_;
};

struct Part {
    PointIndex first = 0, last = -1;
    bool starts_pass = true;
};

/// Cut passes in parts, in order.
std::vector<Part> parts_of(const Passes& passes) {
    std::vector<Part> parts;
    for (std::size_t k = 0; k < passes.size(); ++k) {
        const Pass& pass = passes[k];
        if (pass.kind == PassKind::rapid) continue;
        // Neighbouring pieces of one run (pass, link, the next turn of a spiral) are drawn on.
        const bool continues = k > 0 && passes[k - 1].kind != PassKind::rapid;
        for (PointIndex first = pass.first; first <= pass.last; first += part_points) {
            parts.push_back({first, std::min(pass.last, first + part_points - 1),
                             first == pass.first && !continues});
        }
    }
    return parts;
}

/// Points of a part gathered to vertices.
void gather_vertices(const Projector& projector, const Part& part, std::span<const float> values,
                     float step, Vertices& out) {
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
        // The ends of a part are its vertices, so that parts meet.
        const PointIndex middle = begin == part.first ? begin : end > part.last ? part.last : begin + (end - begin) / 2;
        out.points.push_back(middle);
        out.values.push_back(known > 0 ? static_cast<float>(sum / static_cast<double>(known))
                                       : std::numeric_limits<float>::quiet_NaN());
        out.joined.push_back(joins ? 1 : 0);
        joins = true;
        begin = std::max(end, begin + 1);
    }
}

/// Joins vertices of neighbour passes with triangles.
class Bander {
public:
    Bander(const ClSurface& surface, const Projector& projector, const Vertices& vertices, float step)
        : s_(surface), projector_(projector), v_(vertices), reach_(6.0F * step) {}

    void bands(std::int64_t first, std::int64_t last, Column<std::uint32_t>& triangles,
               Column<std::uint32_t>& segments) const {
        for (std::int64_t b = std::max<std::int64_t>(first, 1); b < last; ++b) {
            if (v_.joined[static_cast<std::size_t>(b)] == 0) continue;
            bool alone = true;
            for (const Side side : {Side::left, Side::right}) {
                const PointIndex i = point(b - 1);
                const PointIndex j = point(b);
                if (!s_.neighbours.has(side, i) || !s_.neighbours.has(side, j)) continue;
                alone = false;
                const PointIndex m = s_.neighbours.neighbour(side, i);
                const PointIndex n = s_.neighbours.neighbour(side, j);
                // Each gap is filled once, from its later pass.
                if (m < i && n < j) band(b, m, n, triangles);
            }
            if (alone) {
                segments.push_back(static_cast<std::uint32_t>(b - 1));
                segments.push_back(static_cast<std::uint32_t>(b));
            }
        }
    }

    /// Fills the turn from one pass to the next: a zigzag's end, from the last place where the passes
    /// see each other to the link's outermost vertex.
    void close_turn(const Pass& link, Column<std::uint32_t>& triangles) const {
        const std::int64_t before = first_vertex_at(link.first);
        std::int64_t b = first_vertex_at(link.last + 1);
        const auto count = static_cast<std::int64_t>(v_.points.size());
        // Gaps are filled from their later pass, so that is where the last band ended.
        for (int looked = 0; b < count && looked < longest_turn; ++b, ++looked) {
            if (b > 0 && v_.joined[static_cast<std::size_t>(b)] == 0) return;
            for (const Side side : {Side::left, Side::right}) {
                if (!s_.neighbours.has(side, point(b))) continue;
                const PointIndex m = s_.neighbours.neighbour(side, point(b));
                if (m >= link.first) continue;
                const std::int64_t a = vertex_of(m);
                if (a < 0 || a >= before || before - a > longest_turn) continue;
                zip(a, b, triangles);
                return;
            }
        }
    }

private:
    [[nodiscard]] std::int64_t first_vertex_at(PointIndex i) const {
        return std::lower_bound(v_.points.begin(), v_.points.end(), i) - v_.points.begin();
    }

    /// Triangles between the vertices from a on and those from b back, until they meet.
    void zip(std::int64_t a, std::int64_t b, Column<std::uint32_t>& triangles) const {
        for (std::int64_t k = a + 1; k <= b; ++k) {
            if (v_.joined[static_cast<std::size_t>(k)] == 0) return;
        }
        while (b - a >= 2) {
            add(triangles, static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a + 1), static_cast<std::uint32_t>(b));
            ++a;
            if (b - a < 2) break;
            add(triangles, static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b - 1), static_cast<std::uint32_t>(b));
            --b;
        }
    }

    [[nodiscard]] PointIndex point(std::int64_t vertex) const {
        return v_.points[static_cast<std::size_t>(vertex)];
    }

    /// The vertex that stands for a point, or −1 where the point is not drawn.
    [[nodiscard]] std::int64_t vertex_of(PointIndex n) const {
        const auto* found = std::lower_bound(v_.points.begin(), v_.points.end(), n);
        std::int64_t best = -1;
        float best_distance = reach_ * reach_;
        const Vec2f at = projector_.pixel(n);
        const std::int64_t k = found - v_.points.begin();
        for (std::int64_t c = std::max<std::int64_t>(0, k - 1); c <= k && c < static_cast<std::int64_t>(v_.points.size()); ++c) {
            const float distance = (projector_.pixel(point(c)) - at).squaredNorm();
            if (distance < best_distance) {
                best_distance = distance;
                best = c;
            }
        }
        return best;
    }

    /// Triangles between the own vertices b − 1, b and the neighbour's from point m to point n.
    void band(std::int64_t b, PointIndex m, PointIndex n, Column<std::uint32_t>& triangles) const {
        const std::int64_t from = vertex_of(m);
        const std::int64_t to = vertex_of(n);
        if (from < 0 || to < 0 || std::abs(to - from) > longest_fan) return;
        const int direction = to >= from ? 1 : -1;
        for (std::int64_t k = from; k != to; k += direction) {
            // A jump to another piece of the way is no neighbour.
            if (v_.joined[static_cast<std::size_t>(std::max(k, k + direction))] == 0) return;
        }
        const auto own = static_cast<std::uint32_t>(b - 1);
        for (std::int64_t k = from; k != to; k += direction) {
            add(triangles, own, static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(k + direction));
        }
        add(triangles, own, static_cast<std::uint32_t>(to), static_cast<std::uint32_t>(b));
    }

    static void add(Column<std::uint32_t>& triangles, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        triangles.push_back(a);
        triangles.push_back(b);
        triangles.push_back(c);
    }

    const ClSurface& s_;
    const Projector& projector_;
    const Vertices& v_;
    float reach_;
};

template <typename T>
void append(Column<T>& all, const Column<T>& part) {
    const std::size_t at = all.size();
    all.resize(at + part.size());
    if (!part.empty()) std::memcpy(all.data() + at, part.data(), part.size() * sizeof(T));
}

void put_positions(const Positions& positions, const Column<PointIndex>& points, Geometry& geometry) {
    geometry.origin = positions.origin;
    geometry.xyz.resize(points.size() * 3);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec3f p = positions[points[k]];
        for (int axis = 0; axis < 3; ++axis) geometry.xyz[3 * k + static_cast<std::size_t>(axis)] = p[axis];
    }
}

/// Vertex normals: the sum of the triangles' (longer for larger ones), turned to z > 0 or, on a
/// vertical wall, left as they come. The tool comes from above on a three-axis machine.
void put_normals(Geometry& geometry) {
    geometry.normals = Column<float>(geometry.xyz.size(), 0.0F);
    const auto at = [](Column<float>& column, std::uint32_t v) {
        return Eigen::Map<Vec3f>(column.data() + std::size_t{3} * v);
    };
    for (std::size_t t = 0; t + 2 < geometry.triangles.size(); t += 3) {
        const std::uint32_t a = geometry.triangles[t];
        const std::uint32_t b = geometry.triangles[t + 1];
        const std::uint32_t c = geometry.triangles[t + 2];
        const Vec3f pa = at(geometry.xyz, a);
        Vec3f n = (at(geometry.xyz, b) - pa).cross(at(geometry.xyz, c) - pa);
        if (n.z() < 0) n = -n;
        at(geometry.normals, a) += n;
        at(geometry.normals, b) += n;
        at(geometry.normals, c) += n;
    }
    for (std::size_t v = 0; v < geometry.xyz.size() / 3; ++v) {
        auto n = at(geometry.normals, static_cast<std::uint32_t>(v));
        const float length = n.norm();
        n = length > 0 ? Vec3f(n / length) : Vec3f(Vec3f::UnitZ());
    }
}

}  // namespace

Detail visible_detail(const ClSurface& surface, std::span<const float> values,
                      const DetailRequest& request) {
    const Projector projector(surface, request);
    const auto step = static_cast<float>(request.vertex_step);
    const std::vector<Part> parts = parts_of(surface.passes);
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
    }
    of_part.clear();

    Detail detail;
    Geometry& geometry = detail.geometry;
    put_positions(surface.positions, all.points, geometry);
    const auto count = static_cast<std::int64_t>(all.points.size());
    if (request.style == Style::surface) {
        const Bander bander(surface, projector, all, step);
        constexpr std::int64_t grain = 16384;
        const auto pieces = static_cast<std::size_t>((count + grain - 1) / grain);
        std::vector<Column<std::uint32_t>> triangles(pieces);
        std::vector<Column<std::uint32_t>> segments(pieces);
        parallel_for(count, grain, [&](std::int64_t first, std::int64_t last) {
            const auto piece = static_cast<std::size_t>(first / grain);
            bander.bands(first, last, triangles[piece], segments[piece]);
        });
        for (std::size_t piece = 0; piece < pieces; ++piece) {
            append(geometry.triangles, triangles[piece]);
            append(geometry.segments, segments[piece]);
        }
        for (const Pass& pass : surface.passes) {
            if (pass.kind == PassKind::link) bander.close_turn(pass, geometry.triangles);
        }
        put_normals(geometry);
    } else if (request.style == Style::lines) {
        for (std::int64_t v = 1; v < count; ++v) {
            if (all.joined[static_cast<std::size_t>(v)] == 0) continue;
            geometry.segments.push_back(static_cast<std::uint32_t>(v - 1));
            geometry.segments.push_back(static_cast<std::uint32_t>(v));
        }
    } else {
        geometry.points.resize(static_cast<std::size_t>(count));
        for (std::int64_t v = 0; v < count; ++v) geometry.points[static_cast<std::size_t>(v)] = static_cast<std::uint32_t>(v);
    }
    detail.values = std::move(all.values);
    detail.points = std::move(all.points);
    return detail;
}

}  // namespace clsurf::viz
