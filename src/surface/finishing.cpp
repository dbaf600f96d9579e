#include "surface/finishing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "core/parallel.h"

namespace clsurf {
namespace {

constexpr double adjacent_share = 0.3;    ///< share of the shorter pass that is adjacent to the other pass
constexpr std::size_t many_passes = 5;    ///< so many adjacent passes are a finished surface of any shape
constexpr double surface_share = 0.6;     ///< share of a smaller group that has a neighbour
constexpr std::size_t fewest_passes = 2;  ///< passes of a group
/// Share of the points of a smaller group with a neighbour above or below.
constexpr double stacked_share = 0.5;
constexpr float upright = 0.9F;           ///< squared cosine to z of a neighbour above
constexpr double many_share = 0.4;        ///< share of a group of many passes that has a neighbour
constexpr float plumb = 0.98F;            ///< squared cosine to z: the turns of a helix, up to 8° steep
constexpr double plumb_share = 0.9;       ///< share of the points of a helix
constexpr double plunge_diameter = 50;    ///< pitches: a narrower helix leads into the material
constexpr PointIndex turn_parts = 8;      ///< parts of a turn, in points; a helix …
constexpr PointIndex climbing_parts = 6;  ///< … climbs in this many of them; levels are joined in a few

/// Disjoint sets of passes.
class Groups {
public:
    explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

    std::size_t of(std::size_t k) {
        while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
        return k;
    }
    void join(std::size_t a, std::size_t b) { parent_[of(a)] = of(b); }

private:
    std::vector<std::size_t> parent_;
};

/// Statistics of the neighbours of a pass's points.
struct NeighbourStatistics {
    PointIndex points = 0;                                ///< number of points with a neighbour
    PointIndex stacked = 0;                               ///< points with a neighbour above or below
    PointIndex plumb = 0;                                 ///< points with a neighbour vertically above or below
    PointIndex climbing = 0;                              ///< all points of the pass if it climbs all along
    double distance = 0;                                  ///< [mm] sum of the distances to vertical neighbours
    Eigen::AlignedBox3f box;                              ///< of the points
    std::unordered_map<std::size_t, PointIndex> of_pass;  ///< neighbours by pass
};

/// Whether the height changes all along the pass, as on a helix, and not in one place, as between levels.
bool climbs_steadily(const Positions& positions, const Pass& pass) {
    if (pass.size() <= turn_parts) return false;
    const auto height_at = [&](PointIndex part) {
        return positions[pass.first + (pass.size() - 1) * part / turn_parts].z();
    };
    const float usual = std::abs(height_at(turn_parts) - height_at(0)) / static_cast<float>(turn_parts);
    PointIndex climbing = 0;
    for (PointIndex part = 0; part < turn_parts; ++part)
        climbing += 2 * std::abs(height_at(part + 1) - height_at(part)) > usual ? 1 : 0;
    return usual > 0 && climbing >= climbing_parts;
}

NeighbourStatistics neighbour_statistics(const ClSurface& surface, const Pass& pass) {
    NeighbourStatistics found;
    if (climbs_steadily(surface.positions, pass)) found.climbing = pass.size();
    // Neighbours stay on one pass for long: they are counted per run.
    struct Counter {
        PointRange range{0, -1};
        std::size_t pass = 0;
        PointIndex points = 0;
    };
    std::array<Counter, 2> counters;
    const auto count = [&](Counter& counter, PointIndex neighbour) {
        if (neighbour < counter.range.first || neighbour > counter.range.last) {
            if (counter.points > 0) found.of_pass[counter.pass] += counter.points;
            const std::size_t other = pass_of(surface.passes, neighbour);
            counter = {{surface.passes[other].first, surface.passes[other].last}, other, 0};
        }
        ++counter.points;
    };
    for (PointIndex i = pass.first; i <= pass.last; ++i) {
        bool any = false;
        bool stacked = false;
        bool plumbs = false;
        found.box.extend(surface.positions[i]);
        for (const Side side : {Side::left, Side::right}) {
            if (!surface.neighbours.has(side, i)) continue;
            any = true;
            const PointIndex n = surface.neighbours.neighbour(side, i);
            count(counters[static_cast<std::size_t>(side)], n);
            const Eigen::Vector3f d = surface.positions[n] - surface.positions[i];
            stacked = stacked || d.z() * d.z() > upright * d.squaredNorm();
            if (!plumbs && d.z() * d.z() > plumb * d.squaredNorm()) {
                plumbs = true;
                found.distance += std::abs(static_cast<double>(d.z()));
            }
        }
        found.points += any ? 1 : 0;
        found.stacked += stacked ? 1 : 0;
        found.plumb += plumbs ? 1 : 0;
    }
    for (const Counter& counter : counters) {
        if (counter.points > 0) found.of_pass[counter.pass] += counter.points;
    }
    return found;
}

/// A group of adjacent passes.
struct Group {
    std::size_t passes = 0;
    PointIndex points = 0;
    NeighbourStatistics neighbours;
    double climb = 0;  ///< [mm] sum of the differences in height of all passes

    void add(const Pass& pass, const NeighbourStatistics& its) {
        ++passes;
        points += pass.size();
        neighbours.points += its.points;
        neighbours.stacked += its.stacked;
        neighbours.plumb += its.plumb;
        neighbours.climbing += its.climbing;
        neighbours.distance += its.distance;
        neighbours.box.extend(its.box);
        climb += its.box.isEmpty() ? 0.0 : static_cast<double>(its.box.sizes().z());
    }

    [[nodiscard]] bool finishes() const {
        if (plunges()) return false;
        const auto share = [](PointIndex part, PointIndex whole) {
            return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
        };
        const double has_neighbour = share(neighbours.points, points);
        if (passes >= many_passes) return has_neighbour >= many_share;
        const bool levels = share(neighbours.stacked, neighbours.points) > stacked_share;
        return passes >= fewest_passes && !levels && has_neighbour >= surface_share;
    }

private:
    /// Whether it is a helix down into the material: its turns are vertically above each other, and it is narrow for
    /// its pitch.
    [[nodiscard]] bool plunges() const {
        const auto plumb_points = static_cast<double>(neighbours.plumb);
        if (neighbours.plumb == 0 || plumb_points < plumb_share * static_cast<double>(neighbours.points)) return false;
        const double pitch = neighbours.distance / plumb_points;
        if (climb < 0.5 * pitch * static_cast<double>(passes) || 2 * neighbours.climbing < points)
            return false;  // levels
        return static_cast<double>(neighbours.box.sizes().head<2>().maxCoeff()) < plunge_diameter * pitch;
    }
};

}  // namespace

std::vector<bool> find_finishing_passes(const ClSurface& surface) {
    const Passes& passes = surface.passes;
    Groups groups(passes.size());
    std::vector<NeighbourStatistics> neighbours(passes.size());
    parallel_for(static_cast<std::int64_t>(passes.size()), 1, [&](std::int64_t first, std::int64_t last) {
        for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(last); ++k) {
            if (passes[k].kind == PassKind::cut) neighbours[k] = neighbour_statistics(surface, passes[k]);
        }
    });
    for (std::size_t k = 0; k < passes.size(); ++k) {
        for (const auto& [other, points] : neighbours[k].of_pass) {
            const PointIndex shorter = std::min(passes[k].size(), passes[other].size());
            if (other != k && static_cast<double>(points) >= adjacent_share * static_cast<double>(shorter))
                groups.join(k, other);
        }
    }
    std::vector<Group> all(passes.size());
    for (std::size_t k = 0; k < passes.size(); ++k) {
        if (passes[k].kind == PassKind::cut) all[groups.of(k)].add(passes[k], neighbours[k]);
    }
    std::vector<bool> finishing(passes.size(), false);
    for (std::size_t k = 0; k < passes.size(); ++k)
        finishing[k] = passes[k].kind == PassKind::cut && all[groups.of(k)].finishes();
    return finishing;
}

}  // namespace clsurf
