#include "optimize/cure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "optimize/levelling.h"
#include "surface/station.h"

namespace clsurf {
namespace {

constexpr double levelled_reach = 1;  ///< [mm] of way before and behind a defect that is levelled with it
constexpr double lag_aim = 0.95;      ///< of the threshold, that a lag step is brought down to
constexpr double slowest = 0.6;       ///< of its speed, to which a place is slowed at most for that
constexpr int most_selections = 10;

/// Which defect the points in each cell of space are levelled for.
class CauseMap {
public:
    void add(const Vec3& p, std::int32_t cause) { causes_.insert_or_assign(cell_of(p), cause); }
    /// That of the nearest cell about a place; −1: none is near.
    [[nodiscard]] std::int32_t near(const Vec3& p) const {
        const Cell centre = cell_of(p);
        std::int32_t found = -1;
        std::int64_t nearest = cells_around * cells_around * 3 + 1;
        for (std::int64_t x = -cells_around; x <= cells_around; ++x) {
            for (std::int64_t y = -cells_around; y <= cells_around; ++y) {
                for (std::int64_t z = -cells_around; z <= cells_around; ++z) {
                    const auto at = x * x + y * y + z * z < nearest
                                        ? causes_.find({centre[0] + x, centre[1] + y, centre[2] + z})
                                        : causes_.end();
                    if (at == causes_.end()) continue;
                    nearest = x * x + y * y + z * z;
                    found = at->second;
                }
            }
        }
        return found;
    }

private:
    using Cell = std::array<std::int64_t, 3>;
    static constexpr std::int64_t cells_around = 3;
    static Cell cell_of(const Vec3& p) {
        return {std::llround(p.x()), std::llround(p.y()), std::llround(p.z())};
    }  // 1 mm wide

    std::map<Cell, std::int32_t> causes_;
};

class Cure {
public:
    Cure(const JudgedRun& run, const CureRules& rules) : run_(run), rules_(rules), own_(compared_speeds(run)) {}

    CuringSpeeds speeds() {
        std::vector<std::uint8_t> taken(run_.report.defects.size(), 1);
        for (std::size_t k = 0; k < taken.size(); ++k) taken[k] = can_be_cured(run_.report.defects[k]) ? 1 : 0;
        for (int k = 0; k < most_selections; ++k) {
            level(taken);
            if (!leave_out_the_dearest(taken)) break;
        }
        return {std::move(speeds_), std::move(causes_)};
    }

private:
    [[nodiscard]] bool can_be_cured(const Defect& defect) const {
        if (defect.quantity == Quantity::relief) return false;
        return std::none_of(rules_.hopeless.begin(), rules_.hopeless.end(),
                            [&](const Vec3& place) { return (place - defect.position).norm() < levelled_reach; });
    }

    /// The speeds for the defects that are taken.
    void level(const std::vector<std::uint8_t>& taken) {
        speeds_ = own_;
        causes_.assign(own_.size(), -1);
        for (std::size_t k = 0; k < taken.size(); ++k) {
            const Defect& defect = run_.report.defects[k];
            if (taken[k] == 0) continue;
            for (const auto* stretches : {&defect.runs, &defect.neighbours}) {
                for (const DefectRun& stretch : *stretches) mark(stretch.points, static_cast<std::int32_t>(k));
            }
            if (defect.quantity == Quantity::lag) slow_for_lag(defect);
        }
        level_speeds(run_, {rules_.step, 0, rules_.ramp}, speeds_, causes_);
    }

    /// A stretch and what lies within `levelled_reach` before and behind it.
    void mark(const PointRange& points, std::int32_t cause) {
        for (PointIndex i = points.first; i <= points.last; ++i) causes_[static_cast<std::size_t>(i)] = cause;
        const auto walk = [&](PointIndex from, PointIndex step) {
            double left = levelled_reach;
            for (PointIndex i = from + step; left > 0 && i >= 0 && i < run_.signals.size() &&
                                             own_[static_cast<std::size_t>(i)] == own_[static_cast<std::size_t>(i)];
                 i += step) {
                causes_[static_cast<std::size_t>(i)] = cause;
                left -= (run_.surface.positions[i] - run_.surface.positions[i - step]).norm();
            }
        };
        walk(points.first, -1);
        walk(points.last, 1);
    }

    void slow_for_lag(const Defect& defect) {
        const double most = lag_aim * run_.report.thresholds.of[index_of(Quantity::lag)];
        for (const auto* stretches : {&defect.runs, &defect.neighbours}) {
            for (const DefectRun& stretch : *stretches) {
                for (PointIndex i = stretch.points.first; i <= stretch.points.last; ++i) {
                    const double share = std::pow(std::max(1.0, lag_step(i) / most), -1 / rules_.lag_power);
                    float& speed = speeds_[static_cast<std::size_t>(i)];
                    if (share >= slowest)
                        speed = std::min(speed, static_cast<float>(share) * own_[static_cast<std::size_t>(i)]);
                }
            }
        }
    }

    /// How far the lag differs from that of the neighbour pass that differs most [mm].
    [[nodiscard]] double lag_step(PointIndex i) const {
        double most = 0;
        for (const Side side : {Side::left, Side::right}) {
            const Station at = beside(run_.surface, {i, 0}, run_.signals.feed(i), side);
            if (!at.exists()) continue;
            const double step =
                std::abs(run_.signals[i].lag - compared_at(run_.signals, at, run_.signals.normal(i)).lag);
            if (step > most) most = step;
        }
        return most;
    }

    /// False: the budget holds.
    bool leave_out_the_dearest(std::vector<std::uint8_t>& taken) const {
        std::vector<double> costs(taken.size(), 0);
        for (std::size_t i = 0; i < own_.size(); ++i) {
            if (causes_[i] >= 0 && speeds_[i] < own_[i])
                costs[static_cast<std::size_t>(causes_[i])] += run_.log.period * (own_[i] / speeds_[i] - 1);
        }
        double sum = std::accumulate(costs.begin(), costs.end(), 0.0);
        if (sum <= rules_.budget) return false;
        std::vector<std::size_t> order(costs.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
        for (const std::size_t k : order) {
            if (sum <= rules_.budget) break;
            sum -= costs[k];
            taken[k] = 0;
        }
        return true;
    }

    const JudgedRun& run_;
    const CureRules& rules_;
    std::vector<float> own_, speeds_;
    std::vector<std::int32_t> causes_;  ///< per point the defect that it is levelled for; −1: none
};

}  // namespace

double lag_power(const Machine& machine) {
    const ServoModel& x = machine.axes[0].servo;
    const bool alike = std::all_of(machine.axes.begin(), machine.axes.begin() + 3, [&](const MachineAxis& axis) {
        return axis.servo.position_gain == x.position_gain &&
               axis.servo.velocity_feedforward == x.velocity_feedforward &&
               axis.servo.velocity_time_constant == x.velocity_time_constant;
    });
    return alike ? 3 : 1;
}

CuringSpeeds curing_speeds(const JudgedRun& run, const CureRules& rules) { return Cure(run, rules).speeds(); }

std::vector<int> gains_of(const CuringSpeeds& cure, const JudgedRun& run, const JudgedRun& cured) {
    CauseMap map;
    for (std::size_t i = 0; i < cure.causes.size(); ++i) {
        if (cure.causes[i] >= 0) map.add(run.surface.positions.absolute(static_cast<PointIndex>(i)), cure.causes[i]);
    }
    std::vector<int> gains(run.report.defects.size(), 0);
    const auto count = [&](const JudgedRun& of, int each) {
        for (const Defect& defect : of.report.defects) {
            if (const std::int32_t cause = map.near(defect.position); cause >= 0)
                gains[static_cast<std::size_t>(cause)] += each;
        }
    };
    count(run, 1);
    count(cured, -1);
    return gains;
}

}  // namespace clsurf
