#include "surface/finishing.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace clsurf {
namespace {

constexpr double beside_share = 0.3;      ///< of the shorter pass that lies beside the other one
constexpr std::size_t many_passes = 5;    ///< side by side: a finished surface, whatever its shape
constexpr double surface_share = 0.6;     ///< of a smaller group that has a neighbour
constexpr std::size_t fewest_passes = 2;  ///< of a group
constexpr double stacked_share =
    0.5;                         ///< of the points of a smaller group that have a neighbour: it lies above or below
constexpr float upright = 0.9F;  ///< squared cosine to z of what lies above

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

/// How the points of a pass lie beside others.
struct Beside {
    PointIndex points = 0;                                ///< with a neighbour
    PointIndex stacked = 0;                               ///< of them, with one above or below
    std::unordered_map<std::size_t, PointIndex> of_pass;  ///< neighbours by pass
};

std::size_t pass_at(const Passes& passes, PointIndex point) {
    const auto after = std::upper_bound(passes.begin(), passes.end(), point,
                                        [](PointIndex i, const Pass& pass) { return i < pass.first; });
    return static_cast<std::size_t>(after - passes.begin()) - 1;
}

Beside look_beside(const ClSurface& surface, const Pass& pass) {
    Beside found;
    PointRange other{0, -1};
    std::size_t index = 0;
    for (PointIndex i = pass.first; i <= pass.last; ++i) {
        bool any = false;
        bool stacked = false;
        for (const Side side : {Side::left, Side::right}) {
            if (!surface.neighbours.has(side, i)) continue;
            any = true;
            const PointIndex n = surface.neighbours.neighbour(side, i);
            if (n < other.first || n > other.last) {
                index = pass_at(surface.passes, n);
                other = {surface.passes[index].first, surface.passes[index].last};
            }
            ++found.of_pass[index];
            const Eigen::Vector3f d = surface.positions[n] - surface.positions[i];
            stacked = stacked || d.z() * d.z() > upright * d.squaredNorm();
        }
        found.points += any ? 1 : 0;
        found.stacked += stacked ? 1 : 0;
    }
    return found;
}

}  // namespace

std::vector<bool> find_finishing_passes(const ClSurface& surface) {
    const Passes& passes = surface.passes;
    Groups groups(passes.size());
    std::vector<PointIndex> beside(passes.size(), 0);
    std::vector<PointIndex> stacked(passes.size(), 0);
    for (std::size_t k = 0; k < passes.size(); ++k) {
        if (passes[k].kind != PassKind::cut) continue;
        const Beside found = look_beside(surface, passes[k]);
        beside[k] = found.points;
        stacked[k] = found.stacked;
        for (const auto& [other, points] : found.of_pass) {
            const PointIndex shorter = std::min(passes[k].size(), passes[other].size());
            if (other != k && static_cast<double>(points) >= beside_share * static_cast<double>(shorter))
                groups.join(k, other);
        }
    }
    struct Group {
        std::size_t passes = 0;
        PointIndex points = 0, beside = 0, stacked = 0;
    };
    std::vector<Group> all(passes.size());
    for (std::size_t k = 0; k < passes.size(); ++k) {
        if (passes[k].kind != PassKind::cut) continue;
        Group& group = all[groups.of(k)];
        ++group.passes;
        group.points += passes[k].size();
        group.beside += beside[k];
        group.stacked += stacked[k];
    }
    std::vector<bool> finishing(passes.size(), false);
    for (std::size_t k = 0; k < passes.size(); ++k) {
        if (passes[k].kind != PassKind::cut) continue;
        const Group& group = all[groups.of(k)];
        const auto points = static_cast<double>(group.points);
        const bool levels = static_cast<double>(group.stacked) > stacked_share * static_cast<double>(group.beside);
        finishing[k] = group.passes >= many_passes || (group.passes >= fewest_passes && !levels &&
                                                       static_cast<double>(group.beside) >= surface_share * points);
    }
    return finishing;
}

}  // namespace clsurf
