#include "compare/defect_match.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "core/cell_grid.h"

namespace clsurf {
namespace {

constexpr double reach_of_step_over = 0.75;
constexpr double usual_reach = 0.5;      ///< [mm] if no step-over is known
constexpr double least_overlap = 0.25;   ///< share of the shorter defect
constexpr double sample_spacing = 0.25;  ///< share of the reach between samples along a run

bool is_height(const Defect& d) { return d.quantity == Quantity::normal_deviation || d.quantity == Quantity::relief; }

/// Evenly spaced places along the sections of a defect [mm].
std::vector<Vec3> samples_of(const Defect& defect, const Positions& positions, double reach) {
    std::vector<Vec3> places;
    for (const DefectSection& section : defect.sections) {
        for (PointIndex i = section.points.first; i <= section.points.last; ++i) {
            const Vec3 place = positions.absolute(i);
            if (!place.allFinite()) continue;
            if (i > section.points.first && !places.empty() && (place - places.back()).norm() < sample_spacing * reach)
                continue;
            places.push_back(place);
        }
    }
    return places;
}

/// Places of many defects, in a grid of cells as large as the reach.
class DefectPlaces {
public:
    explicit DefectPlaces(double reach) : grid_(reach) {}

    void add(const Vec3& place, std::size_t defect) { cells_[grid_.key(place)].push_back({place, defect}); }

    /// Calls f(defect) for each place within the reach.
    template <typename F>
    void near(const Vec3& place, F&& f) const {
        grid_.for_each_near(place, [&](CellGrid::Key key) {
            const auto found = cells_.find(key);
            if (found == cells_.end()) return;
            for (const Entry& entry : found->second) {
                if ((entry.place - place).norm() <= grid_.side()) f(entry.defect);
            }
        });
    }

private:
    struct Entry {
        Vec3 place;
        std::size_t defect;
    };

    CellGrid grid_;
    std::unordered_map<CellGrid::Key, std::vector<Entry>> cells_;
};

/// Overlap of a defect with each of the other defects, in samples. Each sample counts once per other defect.
std::map<std::size_t, std::size_t> overlaps(const std::vector<Vec3>& samples, const DefectPlaces& others) {
    std::map<std::size_t, std::size_t> counts;
    std::vector<std::size_t> here;
    for (const Vec3& place : samples) {
        here.clear();
        others.near(place, [&](std::size_t defect) { here.push_back(defect); });
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
    DefectPlaces places(reach);
    std::vector<std::size_t> sizes;
    for (std::size_t i = 0; i < old.size(); ++i) {
        const std::vector<Vec3> samples = samples_of(old[i], *before.positions, reach);
        sizes.push_back(samples.size());
        for (const Vec3& place : samples) places.add(place, i);
    }
    DefectMatch match;
    std::vector<bool> found(old.size(), false);
    for (const Defect& defect : *after.defects) {
        const std::vector<Vec3> samples = samples_of(defect, *after.positions, reach);
        std::optional<std::size_t> best;
        double most = 0;
        for (const auto& [i, count] : overlaps(samples, places)) {
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
