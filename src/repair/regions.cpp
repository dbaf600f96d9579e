#include "repair/regions.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/cell_grid.h"
#include "repair/repair_mask.h"

namespace clsurf {
namespace {

/// Sums of a run in a cell.
struct CellSum {
    double loss = 0;  ///< defects and mismatch, each as a share of the total of the first run
    double time = 0;  ///< points, one per period

    CellSum& operator+=(const CellSum& other) {
        loss += other.loss;
        time += other.time;
        return *this;
    }
};

using CellSums = std::vector<CellSum>;  ///< one per run

constexpr double least_loss = 1e-4;   ///< as a share of the total: smaller losses do not count
constexpr double counted_from = 0.5;  ///< share of the mismatch of the first run: smaller differences do not count
// The last price is 2^24 times the lowest one: all time then counts 17,000 times as much as all defects.
constexpr int most_prices = 24;        ///< prices of time, each twice the previous one …
constexpr int price_steps = 24;        ///< … and number of halvings between the last two
constexpr double lowest_price = 1e-3;  ///< price of the whole time of the first run, relative to all its defects

/// The limit above which a difference of speed counts, and the total of a run above it [mm/s].
struct Mismatch {
    double usual = 0, all = 0;

    explicit Mismatch(const JudgedRun& run) : usual(counted_from * run.mismatch) {
        for (const float difference : run.speed_differences) all += beyond(difference);
    }
    [[nodiscard]] double beyond(float difference) const {
        return difference == difference ? std::max(0.0, std::abs(difference) - usual) : 0;
    }
};

/// Sums of all runs, in cells of space.
class CellMap {
public:
    CellMap(std::span<const JudgedRun* const> runs, double side) : grid_(side), runs_(runs.size()) {
        const Mismatch mismatch(*runs.front());
        const auto defects = static_cast<double>(std::max<std::size_t>(1, runs.front()->report.defects.size()));
        for (std::size_t k = 0; k < runs.size(); ++k) add(*runs[k], k, mismatch, defects);
    }

    [[nodiscard]] CellGrid::Key key(const Vec3& p) const { return grid_.key(p); }
    [[nodiscard]] const std::unordered_map<CellGrid::Key, CellSums>& cells() const { return cells_; }

    /// Sums over a cell and the cells around it.
    [[nodiscard]] CellSums about(CellGrid::Key key, int aside) const {
        CellSums sums(runs_);
        CellGrid::for_each_near(key, aside, [&](CellGrid::Key near) {
            const auto it = cells_.find(near);
            if (it == cells_.end()) return;
            for (std::size_t k = 0; k < runs_; ++k) sums[k] += it->second[k];
        });
        return sums;
    }

private:
    void add(const JudgedRun& run, std::size_t k, const Mismatch& mismatch, double defects) {
        for (PointIndex i = 0; i < run.surface.positions.size(); ++i) {
            CellSum& sum = at(run, i, k);
            sum.time += 1;
            if (mismatch.all > 0)
                sum.loss += mismatch.beyond(run.speed_differences[static_cast<std::size_t>(i)]) / mismatch.all;
        }
        for (const Defect& defect : run.report.defects) {
            PointIndex points = 0;
            for (const DefectSection& r : defect.sections) points += r.points.size();
            const double each = 1 / (defects * static_cast<double>(points));
            for (const DefectSection& r : defect.sections) {
                for (PointIndex i = r.points.first; i <= r.points.last; ++i) at(run, i, k).loss += each;
            }
        }
    }

    CellSum& at(const JudgedRun& run, PointIndex i, std::size_t k) {
        CellSums& sums = cells_[key(run.surface.positions.absolute(i))];
        sums.resize(runs_);
        return sums[k];
    }

    CellGrid grid_;
    std::size_t runs_;
    std::unordered_map<CellGrid::Key, CellSums> cells_;
};

/// The choice of a run for every cell.
class CellChoice {
public:
    CellChoice(const CellMap& map, std::size_t usual, const RegionRules& rules)
        : usual_(usual), more_time_(rules.more_time) {
        for (const auto& [key, own] : map.cells()) {
            keys_.push_back(key);
            all_time_ += own.front().time;
        }
        std::sort(keys_.begin(), keys_.end());
        for (const CellGrid::Key key : keys_) {
            own_.push_back(&map.cells().at(key));
            about_.push_back(map.about(key, rules.cells_aside));
        }
    }

    /// The best runs that together take no more than the available time.
    [[nodiscard]] std::unordered_map<CellGrid::Key, std::size_t> best() const {
        std::vector<std::size_t> chosen = at_price(0);
        if (is_late(chosen)) chosen = at_lowest_price();
        std::unordered_map<CellGrid::Key, std::size_t> of_cell;
        for (std::size_t i = 0; i < keys_.size(); ++i) of_cell.emplace(keys_[i], chosen[i]);
        return of_cell;
    }

private:
    /// The choice at the lowest price of time at which it is not late.
    [[nodiscard]] std::vector<std::size_t> at_lowest_price() const {
        double low = 0, high = lowest_price / all_time_;
        for (int k = 0; k < most_prices && is_late(at_price(high)); ++k) {
            low = high;
            high *= 2;
        }
        for (int k = 0; k < price_steps; ++k) {
            const double middle = 0.5 * (low + high);
            (is_late(at_price(middle)) ? low : high) = middle;
        }
        return at_price(high);
    }

    /// The best runs if a period costs `price`. None of them has a greater loss than the first run, to save time.
    [[nodiscard]] std::vector<std::size_t> at_price(double price) const {
        std::vector<std::size_t> chosen;
        for (const CellSums& sums : about_) {
            const auto cost = [&](std::size_t k) { return sums[k].loss + price * sums[k].time; };
            const auto may_be = [&](std::size_t k) { return sums[k].loss <= sums[0].loss + least_loss; };
            std::size_t best = may_be(usual_) ? usual_ : 0;
            double least = cost(best) - least_loss;
            for (std::size_t k = 0; k < sums.size(); ++k) {
                if (!may_be(k) || !(cost(k) < least)) continue;
                least = cost(k);
                best = k;
            }
            chosen.push_back(best);
        }
        return chosen;
    }

    [[nodiscard]] bool is_late(const std::vector<std::size_t>& chosen) const {
        double longer = 0;
        for (std::size_t i = 0; i < chosen.size(); ++i) longer += (*own_[i])[chosen[i]].time - own_[i]->front().time;
        return longer > more_time_;
    }

    std::size_t usual_;
    double more_time_;
    std::vector<CellGrid::Key> keys_;
    std::vector<const CellSums*> own_;
    std::vector<CellSums> about_;
    double all_time_ = 0;  ///< of the first run, in periods
};

}  // namespace

std::vector<std::uint8_t> best_runs(std::span<const JudgedRun* const> runs, std::size_t usual, const Program& program,
                                    const RegionRules& rules) {
    const JudgedRun& first = *runs.front();
    const CellMap map(runs, std::max(rules.cell * first.surface.step_over, rules.least_cell));
    const std::unordered_map<CellGrid::Key, std::size_t> chosen = CellChoice(map, usual, rules).best();
    std::vector<std::uint8_t> best(static_cast<std::size_t>(program.motions.size()), static_cast<std::uint8_t>(usual));
    std::vector<std::size_t> of_point;  // one lookup per point
    for (PointIndex i = 0; i < first.surface.positions.size(); ++i)
        of_point.push_back(chosen.at(map.key(first.surface.positions.absolute(i))));
    for (std::size_t k = 0; k < runs.size(); ++k) {
        if (k == usual) continue;
        std::vector<std::uint8_t> marks(of_point.size());
        std::ranges::transform(of_point, marks.begin(), [&](std::size_t run) { return run == k ? 1 : 0; });
        const std::vector<std::uint8_t> marked = marked_motions(first, program, marks);
        for (std::size_t i = 0; i < best.size(); ++i) {
            if (marked[i] != 0) best[i] = static_cast<std::uint8_t>(k);
        }
    }
    return best;
}

}  // namespace clsurf
