#include "machined/scallop_map.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/block.h"
#include "core/error.h"
#include "core/not_finite.h"
#include "core/parallel.h"
#include "core/statistics.h"
#include "machined/contact.h"
#include "machined/scallop.h"

namespace clsurf {
namespace {

constexpr double least_cosine = 0.866;  ///< cos 30°: passes that turn by more neither continue nor are adjacent
constexpr double shortest_piece = 2;    ///< step-overs

/// Whether the path has a corner between two steps.
bool turns(const Vec3& before, const Vec3& after) {
    return before.dot(after) < least_cosine * before.norm() * after.norm();
}

/// Local geometry of the path at a point. Not finite: not known.
struct Place {
    Vec3 feed = Vec3::Constant(missing<double>);
    Vec3 normal = Vec3::Constant(missing<double>);
    double length = 0;  ///< [mm] length of path that the point represents
    /// The point whose neighbours are used. At the end of a pass the adjacent pass may already have ended, and the neighbour
    /// found there belongs to another pass.
    PointIndex inner = 0;
};

class PlacesOfPath {
public:
    PlacesOfPath(const ClSurface& surface, const CuttingTool& tool)
        : surface_(surface), tool_(tool), places_(static_cast<std::size_t>(surface.positions.size())) {
        const auto count = static_cast<std::int64_t>(surface.passes.size());
        parallel_for(count, 1, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t k = first; k < last; ++k) {
                const Pass& pass = surface_.passes[static_cast<std::size_t>(k)];
                if (pass.kind != PassKind::cut) continue;
                for (const PointRange& piece : pieces_of(pass)) {
                    const PointRange inner = without_ends(piece);
                    for (PointIndex i = piece.first; i <= piece.last; ++i) {
                        Place& place = places_[static_cast<std::size_t>(i)];
                        place = place_in(piece, i);
                        place.inner = std::clamp(i, inner.first, inner.last);
                    }
                }
            }
        });
    }

    [[nodiscard]] const Place& operator[](PointIndex i) const { return places_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] Vec3 contact(PointIndex i) const { return tip(i) + contact_offset(tool_, (*this)[i].normal); }

private:
    [[nodiscard]] Vec3 tip(PointIndex i) const { return surface_.positions.absolute(i); }

    /// The pieces between the corners of a pass. Short ones are links between passes and are excluded.
    [[nodiscard]] std::vector<PointRange> pieces_of(const Pass& pass) const {
        std::vector<PointRange> pieces;
        PointIndex first = pass.first;
        double length = 0;
        const auto close = [&](PointIndex last) {
            if (length > shortest_piece * surface_.step_over) pieces.push_back({first, last});
            first = last;
            length = 0;
        };
        Vec3 step = Vec3::Zero();
        for (PointIndex i = pass.first; i < pass.last; ++i) {
            const Vec3 next = tip(i + 1) - tip(i);
            if (!(next.norm() > 0)) continue;
            if (turns(step, next)) close(i);
            step = next;
            length += step.norm();
        }
        close(pass.last);
        return pieces;
    }

    /// Excludes a step-over at both ends. Domain: `piece` is longer than two.
    [[nodiscard]] PointRange without_ends(PointRange piece) const {
        const auto steps = [&](PointIndex from, PointIndex step) {
            double length = 0;
            while (length < surface_.step_over && from + step >= piece.first && from + step <= piece.last) {
                length += (tip(from + step) - tip(from)).norm();
                from += step;
            }
            return from;
        };
        const PointIndex first = steps(piece.first, 1), last = steps(piece.last, -1);
        return first <= last ? PointRange{first, last} : piece;
    }

    [[nodiscard]] Place place_in(const PointRange& piece, PointIndex i) const {
        const PointIndex before = std::max(piece.first, i - 1), after = std::min(piece.last, i + 1);
        Place place;
        const Vec3 along = tip(after) - tip(before);
        place.length = 0.5 * ((tip(i) - tip(before)).norm() + (tip(after) - tip(i)).norm());
        if (!(along.norm() > 0)) return place;
        place.feed = along.normalized();
        const Adjacency& neighbours = surface_.neighbours;
        const auto beside = [&](Side side) {
            return neighbours.has(side, i) ? tip(neighbours.neighbour(side, i)) : tip(i);
        };
        Vec3 across = beside(Side::left) - beside(Side::right);
        across -= across.dot(place.feed) * place.feed;
        const Vec3 normal = place.feed.cross(across);
        if (normal.norm() > 0) place.normal = (normal.z() < 0 ? -normal : normal).normalized();
        return place;
    }

    const ClSurface& surface_;
    const CuttingTool& tool_;
    std::vector<Place> places_;
};

/// Uncut material next to a point: cusps, and a share of the gaps to passes that are too far away.
struct UncutMaterial {
    double height = missing<double>;
    double gap = 0;  ///< [mm] half of the widths of both gaps
};

UncutMaterial uncut_next_to(const ClSurface& surface, const PlacesOfPath& places, double ball, PointIndex i) {
    UncutMaterial result;
    const Place& here = places[i];
    if (!here.normal.allFinite()) return result;
    for (const Side side : {Side::left, Side::right}) {
        if (!surface.neighbours.has(side, i)) continue;
        const PointIndex j = surface.neighbours.neighbour(side, i);
        if (!(std::abs(places[j].feed.dot(here.feed)) >= least_cosine)) continue;
        Vec3 apart = places.contact(j) - places.contact(i);
        if (!apart.allFinite()) continue;
        apart -= apart.dot(here.feed) * here.feed;
        const double turn = (places[j].normal - here.normal).dot(apart);
        result.gap += 0.5 * std::max(0.0, apart.norm() - 2 * ball);
        const double height = cusp_height(ball, apart.norm(), turn);
        if (std::isfinite(height) && !(result.height >= height)) result.height = height;
    }
    if (result.gap > 0)
        result.height = ball;  // the limit of cusps of passes that just meet; the actual height is greater
    return result;
}

}  // namespace

ScallopMap scallop_map(const ClSurface& surface, const CuttingTool& tool) {
    if (tool.kind != ToolKind::ball)
        throw UsageError("scallops are computed for ball-end tools, not for " + to_text(tool), "--tool ball:D");
    const PlacesOfPath places(surface, tool);
    const PointIndex count = surface.positions.size();
    ScallopMap map;
    map.height = Column<float>(static_cast<std::size_t>(count), missing<float>);
    std::vector<double> gaps(static_cast<std::size_t>(count), 0);
    parallel_for(count, block_points, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t i = first; i < last; ++i) {
            if (!(places[i].length > 0)) continue;
            const UncutMaterial found = uncut_next_to(surface, places, tool.radius, places[i].inner);
            map.height[static_cast<std::size_t>(i)] = static_cast<float>(found.height);
            gaps[static_cast<std::size_t>(i)] = found.gap * places[i].length;
        }
    });
    std::vector<std::pair<float, double>> heights;
    for (PointIndex i = 0; i < count; ++i) {
        map.uncut += gaps[static_cast<std::size_t>(i)];
        const float height = map.height[static_cast<std::size_t>(i)];
        if (std::isfinite(height)) heights.emplace_back(height, places[i].length);
    }
    const auto height_at = [&](double share) {
        return heights.empty() ? missing<double> : weighted_quantile(heights, share);
    };
    map.median = height_at(0.5);
    map.p95 = height_at(0.95);
    map.most = height_at(1);
    return map;
}

}  // namespace clsurf
