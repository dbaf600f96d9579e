#include "surface/surface_part.h"

#include <algorithm>
#include <limits>
#include <set>

#include "core/point_ranges.h"

namespace clsurf {
namespace {

// Bands and seams of triangles depend on the adjacent bands. With two passes each, some triangles at the edge of a part
// are not those of the whole surface (tests/cli/read_pieces.py).
constexpr std::size_t passes_along = 8;  ///< passes before and after the part
constexpr int passes_aside = 4;

using PassNumbers = std::set<std::size_t>;

/// Adds the passes adjacent to a pass. Neighbours stay on one pass for long.
void add_adjacent(const ClSurface& surface, const Pass& pass, PassNumbers& found) {
    for (const Side side : {Side::left, Side::right}) {
        PointRange known;
        for (PointIndex i = pass.first; i <= pass.last; ++i) {
            if (!surface.neighbours.has(side, i)) continue;
            const PointIndex n = surface.neighbours.neighbour(side, i);
            if (n >= known.first && n <= known.last) continue;
            const std::size_t number = pass_of(surface.passes, n);
            known = {surface.passes[number].first, surface.passes[number].last};
            found.insert(number);
        }
    }
}

PassNumbers passes_of(const ClSurface& surface, const PointRange& own) {
    const std::size_t first = pass_of(surface.passes, own.first), last = pass_of(surface.passes, own.last);
    PassNumbers all;
    const std::size_t end = std::min(surface.passes.size() - 1, last + passes_along);
    for (std::size_t k = first - std::min(first, passes_along); k <= end; ++k) all.insert(k);
    PassNumbers fresh;
    for (std::size_t k = first; k <= last; ++k) fresh.insert(k);
    for (int aside = 0; aside < passes_aside; ++aside) {
        PassNumbers adjacent;
        for (const std::size_t k : fresh) add_adjacent(surface, surface.passes[k], adjacent);
        fresh.clear();
        for (const std::size_t k : adjacent) {
            if (all.insert(k).second) fresh.insert(k);
        }
    }
    return all;
}

/// Appends points and passes, and separates passes that are not consecutive.
class PartBuilder {
public:
    explicit PartBuilder(const ClSurface& whole) : whole_(whole) {
        part_.surface.step_over = whole.step_over;
        part_.surface.positions.origin = whole.positions.origin;
    }

    void add(const Pass& pass) {
        const bool follows = !part_.ranges.empty() && part_.ranges.back().last + 1 == pass.first;
        if (!follows) {
            if (!part_.ranges.empty()) add_nowhere();
            part_.ranges.push_back({pass.first, pass.first - 1});
            begin_.push_back(size());
        }
        const PointIndex first = size();
        for (PointIndex i = pass.first; i <= pass.last; ++i) add_point(i, whole_.positions[i]);
        part_.ranges.back().last = pass.last;
        part_.surface.passes.push_back({first, size() - 1, pass.kind});
    }

    SurfacePart finish(const PointRange& own) {
        part_.own = {place_of(own.first), place_of(own.last)};
        ClSurface& surface = part_.surface;
        for (const Side side : {Side::left, Side::right}) {
            Column<std::int32_t>& column = side == Side::left ? surface.neighbours.left : surface.neighbours.right;
            column = Column<std::int32_t>(part_.points.size(), Adjacency::none);
            for (PointIndex k = 0; k < size(); ++k) {
                const PointIndex i = part_.points[static_cast<std::size_t>(k)];
                if (i < 0 || !whole_.neighbours.has(side, i)) continue;
                const PointIndex n = place_of(whole_.neighbours.neighbour(side, i));
                if (n >= 0) column[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(n - k);
            }
        }
        for (const PointRange& move : whole_.step_over_moves) {
            const PointIndex first = place_of(move.first), last = place_of(move.last);
            if (first >= 0 && last - first == move.last - move.first) surface.step_over_moves.push_back({first, last});
        }
        return std::move(part_);
    }

private:
    [[nodiscard]] PointIndex size() const { return static_cast<PointIndex>(part_.points.size()); }

    void add_point(PointIndex point, const Eigen::Vector3f& p) {
        part_.points.push_back(point);
        part_.surface.positions.x.push_back(p.x());
        part_.surface.positions.y.push_back(p.y());
        part_.surface.positions.z.push_back(p.z());
    }

    void add_nowhere() {
        part_.surface.passes.push_back({size(), size(), PassKind::rapid});
        add_point(-1, Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
    }

    /// −1 if it is not in the part.
    [[nodiscard]] PointIndex place_of(PointIndex point) const {
        if (!any_has(part_.ranges, point)) return -1;
        const auto range = range_at(part_.ranges, point);
        return begin_[static_cast<std::size_t>(range - part_.ranges.begin())] + point - range->first;
    }

    const ClSurface& whole_;
    SurfacePart part_;
    std::vector<PointIndex> begin_;  ///< first point of each range in the part
};

}  // namespace

SurfacePart part_with_neighbours(const ClSurface& surface, const PointRange& own) {
    if (own.size() <= 0) return {};
    PartBuilder builder(surface);
    for (const std::size_t k : passes_of(surface, own)) builder.add(surface.passes[k]);
    return builder.finish(own);
}

}  // namespace clsurf
