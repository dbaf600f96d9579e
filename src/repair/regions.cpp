#include "repair/regions.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "core/cell_grid.h"
#include "repair/repair_mask.h"

namespace clsurf {
namespace {

/// What a run has more in a cell than another one.
struct Excess {
    double defects = 0, mismatch = 0;  ///< shares of all that the other one has
    std::int64_t points = 0;           ///< one a period

    [[nodiscard]] double loss() const { return defects + mismatch; }
    Excess& operator+=(const Excess& other) {
        defects += other.defects;
        mismatch += other.mismatch;
        points += other.points;
        return *this;
    }
};

constexpr double least_loss = 1e-4;   ///< that counts, a share of all
constexpr double counted_from = 0.5;  ///< of the mismatch before: smaller differences are none

class CellMap {
public:
    explicit CellMap(double side) : grid_(side) {}

    [[nodiscard]] CellGrid::Key key(const Vec3& p) const { return grid_.key(p); }
    Excess& at(CellGrid::Key key) { return cells_[key]; }

    /// Every cell's sum with those around it, in the order of their keys.
    [[nodiscard]] std::vector<std::pair<CellGrid::Key, Excess>> sums(int aside) const {
        std::vector<std::pair<CellGrid::Key, Excess>> result;
        for (const auto& [key, own] : cells_) {
            Excess sum;
            CellGrid::for_each_near(key, aside, [&](CellGrid::Key near) {
                if (const auto it = cells_.find(near); it != cells_.end()) sum += it->second;
            });
            result.emplace_back(key, sum);
        }
        std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        return result;
    }

private:
    CellGrid grid_;
    std::unordered_map<CellGrid::Key, Excess> cells_;
};

/// Beyond what a difference of speed counts, and how much of that a run has in all [mm/s].
struct Mismatch {
    double usual = 0, all = 0;

    explicit Mismatch(const JudgedRun& run) : usual(counted_from * run.mismatch) {
        for (const float difference : run.speed_differences) all += beyond(difference);
    }
    [[nodiscard]] double beyond(float difference) const {
        return difference == difference ? std::max(0.0, std::abs(difference) - usual) : 0;
    }
};

/// Adds what a run has to the cells, or takes it away (sign −1), as shares of what the run before has.
void add(const JudgedRun& run, int sign, const Mismatch& mismatch, std::size_t defects, CellMap& map) {
    const auto cell_of = [&](PointIndex i) -> Excess& { return map.at(map.key(run.surface.positions.absolute(i))); };
    for (PointIndex i = 0; i < run.surface.positions.size(); ++i) {
        Excess& cell = cell_of(i);
        cell.points += sign;
        if (mismatch.all > 0)
            cell.mismatch += sign * mismatch.beyond(run.speed_differences[static_cast<std::size_t>(i)]) / mismatch.all;
    }
    for (const Defect& defect : run.report.defects) {
        PointIndex points = 0;
        for (const DefectRun& r : defect.runs) points += r.points.size();
        const double each =
            sign / (static_cast<double>(std::max<std::size_t>(1, defects)) * static_cast<double>(points));
        for (const DefectRun& r : defect.runs) {
            for (PointIndex i = r.points.first; i <= r.points.last; ++i) cell_of(i).defects += each;
        }
    }
}

std::unordered_set<CellGrid::Key> cells_to_restore(CellMap& map, int aside) {
    std::unordered_set<CellGrid::Key> restored;
    std::vector<std::pair<double, CellGrid::Key>> expensive;  // the time that a gain takes, and where
    std::int64_t longer = 0;                                  // than before, outside the restored cells [periods]
    for (const auto& [key, sum] : map.sums(aside)) {
        if (sum.loss() > least_loss) {
            restored.insert(key);
            continue;
        }
        longer += map.at(key).points;
        if (sum.points > 0)
            expensive.emplace_back(static_cast<double>(sum.points) / std::max(-sum.loss(), least_loss), key);
    }
    std::stable_sort(expensive.begin(), expensive.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [time_per_gain, key] : expensive) {
        if (longer <= 0) break;
        longer -= map.at(key).points;
        restored.insert(key);
    }
    return restored;
}

}  // namespace

std::vector<std::uint8_t> worse_motions(const JudgedRun& before, const JudgedRun& after, const Program& program,
                                        const RegionRules& rules) {
    CellMap map(std::max(rules.cell * before.surface.step_over, rules.least_cell));
    const Mismatch mismatch(before);
    add(before, -1, mismatch, before.report.defects.size(), map);
    add(after, 1, mismatch, before.report.defects.size(), map);
    const std::unordered_set<CellGrid::Key> restored = cells_to_restore(map, rules.cells_aside);
    std::vector<std::uint8_t> marks(static_cast<std::size_t>(before.surface.positions.size()), 0);
    for (std::size_t i = 0; i < marks.size(); ++i)
        marks[i] = restored.contains(map.key(before.surface.positions.absolute(static_cast<PointIndex>(i)))) ? 1 : 0;
    return marked_motions(before, program, marks);
}

}  // namespace clsurf
