#include "compare/defect_match.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>

namespace clsurf {
namespace {

constexpr double reach_of_step_over = 0.75;
constexpr double usual_reach = 0.5;      ///< [mm] where no step-over is known
constexpr double least_overlap = 0.25;   ///< of the shorter one
constexpr double sample_spacing = 0.25;  ///< of samples along a run, of the reach

bool is_height(const Defect& d) { return d.quantity == Quantity::lag || d.quantity == Quantity::relief; }

/// Its runs as places, evenly spaced [mm].
std::vector<Vec3> samples_of(const Defect& defect, const Positions& positions, double reach) {
    std::vector<Vec3> places;
    for (const DefectRun& run : defect.runs) {
        for (PointIndex i = run.points.first; i <= run.points.last; ++i) {
            const Vec3 place = positions.absolute(i);
            if (!place.allFinite()) continue;
            if (i > run.points.first && !places.empty() && (place - places.back()).norm() < sample_spacing * reach)
                continue;
            places.push_back(place);
        }
    }
    return places;
}

/// Places of many defects in cells as large as the reach.
class Grid {
public:
    explicit Grid(double reach) : reach_(reach) {}

    void add(const Vec3& place, std::size_t defect) { cells_[key(cell_of(place))].push_back({place, defect}); }

    /// Calls f(defect) for each place within the reach.
    template <typename F>
    void near(const Vec3& place, F&& f) const {
        const Cell at = cell_of(place);
        for (int k = 0; k < 27; ++k) {
            const auto found = cells_.find(key({at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1}));
            if (found == cells_.end()) continue;
            for (const Entry& entry : found->second) {
                if ((entry.place - place).norm() <= reach_) f(entry.defect);
            }
        }
    }

private:
    using Cell = std::array<std::int64_t, 3>;
    struct Entry {
        Vec3 place;
        std::size_t defect;
    };
    [[nodiscard]] Cell cell_of(const Vec3& place) const {
        const auto along = [&](double c) { return static_cast<std::int64_t>(std::floor(c / reach_)); };
        return {along(place.x()), along(place.y()), along(place.z())};
    }
    /// 21 bits an axis; what falls together is told apart by distance.
    [[nodiscard]] static std::uint64_t key(const Cell& cell) {
        constexpr std::uint64_t mask = (1U << 21) - 1;
        const auto bits = [](std::int64_t c) { return static_cast<std::uint64_t>(c) & mask; };
        return bits(cell[0]) << 42 | bits(cell[1]) << 21 | bits(cell[2]);
    }

    double reach_;
    std::unordered_map<std::uint64_t, std::vector<Entry>> cells_;
};

/// How much of a defect lies on each defect of the grid, in samples. Each sample counts once for each.
std::map<std::size_t, std::size_t> overlaps(const std::vector<Vec3>& samples, const Grid& grid) {
    std::map<std::size_t, std::size_t> counts;
    std::vector<std::size_t> here;
    for (const Vec3& place : samples) {
        here.clear();
        grid.near(place, [&](std::size_t defect) { here.push_back(defect); });
        std::sort(here.begin(), here.end());
        here.erase(std::unique(here.begin(), here.end()), here.end());
        for (const std::size_t defect : here) ++counts[defect];
    }
    return counts;
}

double reach_of(const LocatedDefects& a, const LocatedDefects& b) {
    const double step_over = std::max(a.step_over, b.step_over);
    return step_over > 0 ? reach_of_step_over * step_over : usual_reach;
}

}  // namespace

std::size_t DefectMatch::remaining() const {
    return static_cast<std::size_t>(
        std::count_if(before_of.begin(), before_of.end(), [](const auto& before) { return before.has_value(); }));
}
std::size_t DefectMatch::fresh() const { return before_of.size() - remaining(); }

DefectMatch match_defects(const LocatedDefects& before, const LocatedDefects& after) {
    const double reach = reach_of(before, after);
    const std::vector<Defect>& old = *before.defects;
    Grid grid(reach);
    std::vector<std::size_t> sizes;
    for (std::size_t i = 0; i < old.size(); ++i) {
        const std::vector<Vec3> samples = samples_of(old[i], *before.positions, reach);
        sizes.push_back(samples.size());
        for (const Vec3& place : samples) grid.add(place, i);
    }
    DefectMatch match;
    std::vector<bool> found(old.size(), false);
    for (const Defect& defect : *after.defects) {
        const std::vector<Vec3> samples = samples_of(defect, *after.positions, reach);
        std::optional<std::size_t> best;
        double most = 0;
        for (const auto& [i, count] : overlaps(samples, grid)) {
            if (is_height(old[i]) != is_height(defect) || old[i].systematic != defect.systematic) continue;
            const auto shorter = static_cast<double>(std::min(sizes[i], samples.size()));
            const double share = std::min(1.0, static_cast<double>(count) / shorter);
            if (share < least_overlap) continue;
            found[i] = true;
            if (share > most) {
                most = share;
                best = i;
            }
        }
        match.before_of.push_back(best);
    }
    for (std::size_t i = 0; i < old.size(); ++i) {
        if (!found[i]) match.gone.push_back(i);
    }
    return match;
}

}  // namespace clsurf
