#include "repair/feeds/feed_reduction.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>

#include "core/cell_grid.h"
#include "core/parallel.h"
#include "repair/feeds/feed_equalisation.h"
#include "surface/path_location.h"

namespace clsurf {
namespace {

constexpr double equalised_reach = 1;  ///< [mm] arc length before and after a defect that is equalised with it
constexpr double lag_aim = 0.95;       ///< share of the threshold to which a lag step is reduced
constexpr double slowest = 0.6;        ///< least share of its speed to which a place is slowed for this
constexpr double most_equalised =
    2;  ///< times the cost of slowing alone: limit of the cost of a lag step with equalisation

/// The index of the defect for which the points in each cell of space are equalised.
class CauseMap {
public:
    void add(const Vec3& p, std::int32_t cause) { causes_.insert_or_assign(key(p), cause); }
    /// The index of the nearest cell around a place; −1: there is none.
    [[nodiscard]] std::int32_t near(const Vec3& p) const {
        const CellGrid::Key centre = key(p);
        std::int32_t found = -1;
        int nearest = cells_around * cells_around * 3 + 1;
        for (int x = -cells_around; x <= cells_around; ++x) {
            for (int y = -cells_around; y <= cells_around; ++y) {
                for (int z = -cells_around; z <= cells_around; ++z) {
                    if (x * x + y * y + z * z >= nearest) continue;
                    const auto at = causes_.find(centre + CellGrid::step(x, y, z));
                    if (at == causes_.end()) continue;
                    nearest = x * x + y * y + z * z;
                    found = at->second;
                }
            }
        }
        return found;
    }

private:
    static constexpr int cells_around = 3;
    static constexpr double side = 1;  ///< [mm]

    /// The centres of cells are at whole millimetres.
    [[nodiscard]] CellGrid::Key key(const Vec3& p) const { return cells_.key(p + Vec3::Constant(side / 2)); }

    CellGrid cells_{side};
    std::unordered_map<CellGrid::Key, std::int32_t> causes_;
};

class FeedReducer {
public:
    FeedReducer(const JudgedRun& run, const FeedReductionRules& rules)
        : run_(run), rules_(rules), equaliser_(run), equalised_(run.report.defects.size(), 1) {}

    /// Speeds for the least expensive defects, each priced alone: as many of them as the budget allows together.
    ReducedSpeeds speeds() {
        const std::vector<std::int32_t> order = by_cost();
        std::size_t paid = 0, too_many = order.size() + 1;
        ReducedSpeeds best = reduced({});
        for (std::size_t many = order.size(); paid + 1 < too_many; many = (paid + too_many) / 2) {
            ReducedSpeeds reduction = reduced(std::span(order).first(many));
            const bool holds = equaliser_.lost(reduction.speeds) <= rules_.budget;
            (holds ? paid : too_many) = many;
            if (holds) best = std::move(reduction);
        }
        return best;
    }

private:
    /// The defects that can be reduced, the least expensive first.
    [[nodiscard]] std::vector<std::int32_t> by_cost() {
        std::vector<std::int32_t> order;
        for (std::size_t k = 0; k < run_.report.defects.size(); ++k) {
            if (can_be_reduced(run_.report.defects[k])) order.push_back(static_cast<std::int32_t>(k));
        }
        std::vector<double> costs(run_.report.defects.size(), 0);
        parallel_for(static_cast<std::int64_t>(order.size()), 1, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t n = first; n < last; ++n) {
                const std::int32_t k = order[static_cast<std::size_t>(n)];
                costs[static_cast<std::size_t>(k)] = cost_alone(k);
            }
        });
        std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
            return costs[static_cast<std::size_t>(a)] < costs[static_cast<std::size_t>(b)];
        });
        return order;
    }

    /// The cost of a defect alone; also decides whether it is equalised. A lag step may be next to other slow places, whose
    /// equalisation can cost much more.
    [[nodiscard]] double cost_alone(std::int32_t k) {
        const double cost = equaliser_.lost(reduced({&k, 1}).speeds);
        if (run_.report.defects[static_cast<std::size_t>(k)].quantity != Quantity::normal_deviation) return cost;
        equalised_[static_cast<std::size_t>(k)] = 0;
        const double slowed = equaliser_.lost(reduced({&k, 1}).speeds);
        if (cost >= most_equalised * slowed) return slowed;
        equalised_[static_cast<std::size_t>(k)] = 1;
        return cost;
    }

    [[nodiscard]] bool can_be_reduced(const Defect& defect) const {
        if (defect.quantity == Quantity::relief) return false;
        return std::none_of(rules_.abandoned.begin(), rules_.abandoned.end(),
                            [&](const Vec3& place) { return (place - defect.place.tip).norm() < equalised_reach; });
    }

    /// The speeds for some of the defects.
    [[nodiscard]] ReducedSpeeds reduced(std::span<const std::int32_t> taken) const {
        const std::size_t n = equaliser_.own().size();
        FeedEqualisation equalisation{equaliser_.own(), std::vector<std::int32_t>(n, -1),
                                      std::vector<std::uint8_t>(n, 0)};
        for (const std::int32_t k : taken) {
            const Defect& defect = run_.report.defects[static_cast<std::size_t>(k)];
            for (const auto* segments : {&defect.sections, &defect.neighbours}) {
                for (const DefectSection& segment : *segments) mark(segment.points, k, equalisation);
            }
            if (defect.quantity == Quantity::normal_deviation) slow_for_lag(defect, equalisation.speeds);
        }
        equaliser_.equalise({rules_.step, 0, rules_.ramp}, equalisation);
        return {std::move(equalisation.speeds), std::move(equalisation.causes)};
    }

    /// Marks a section, and the points within `equalised_reach` before and after it.
    void mark(const PointRange& points, std::int32_t cause, FeedEqualisation& equalisation) const {
        const bool equalised = equalised_[static_cast<std::size_t>(cause)] != 0;
        const auto mark_point = [&](PointIndex i) {
            equalisation.causes[static_cast<std::size_t>(i)] = cause;
            if (equalised) equalisation.equalised[static_cast<std::size_t>(i)] = 1;
        };
        for (PointIndex i = points.first; i <= points.last; ++i) mark_point(i);
        const std::vector<float>& own = equaliser_.own();
        const auto walk = [&](PointIndex from, PointIndex step) {
            double left = equalised_reach;
            for (PointIndex i = from + step; left > 0 && i >= 0 && i < run_.signals.size() &&
                                             own[static_cast<std::size_t>(i)] == own[static_cast<std::size_t>(i)];
                 i += step) {
                mark_point(i);
                left -= (run_.surface.positions[i] - run_.surface.positions[i - step]).norm();
            }
        };
        walk(points.first, -1);
        walk(points.last, 1);
    }

    void slow_for_lag(const Defect& defect, std::vector<float>& speeds) const {
        const double most = lag_aim * run_.report.thresholds.of[index_of(Quantity::normal_deviation)];
        for (const auto* segments : {&defect.sections, &defect.neighbours}) {
            for (const DefectSection& segment : *segments) {
                for (PointIndex i = segment.points.first; i <= segment.points.last; ++i) {
                    const double share = std::pow(std::max(1.0, lag_step(i) / most), -1 / rules_.lag_power);
                    float& speed = speeds[static_cast<std::size_t>(i)];
                    if (share >= slowest)
                        speed =
                            std::min(speed, static_cast<float>(share) * equaliser_.own()[static_cast<std::size_t>(i)]);
                }
            }
        }
    }

    /// The difference of the lag from the lag of the adjacent pass that differs most [mm].
    [[nodiscard]] double lag_step(PointIndex i) const {
        double most = 0;
        for (const Side side : {Side::left, Side::right}) {
            const PathLocation at = adjacent_location(run_.surface, {i, 0}, run_.signals.feed(i), side);
            if (!at.exists()) continue;
            const double step = std::abs(run_.signals[i].normal_deviation -
                                         compared_at(run_.signals, at, run_.signals.normal(i)).normal_deviation);
            if (step > most) most = step;
        }
        return most;
    }

    const JudgedRun& run_;
    const FeedReductionRules& rules_;
    FeedEqualiser equaliser_;
    std::vector<std::uint8_t> equalised_;  ///< per defect, whether speeds around it are equalised
};

}  // namespace

double lag_power(const Machine& machine) {
    const ServoModel& x = machine.axes[0].servo;
    const bool alike = std::all_of(machine.axes.begin(), machine.axes.begin() + 3, [&](const MachineAxis& axis) {
        return axis.servo.position_gain == x.position_gain &&
               axis.servo.velocity_feedforward == x.velocity_feedforward &&
               axis.servo.velocity_time_constant == x.velocity_time_constant &&
               axis.servo.velocity_integral_time == x.velocity_integral_time && axis.servo.dead_time == x.dead_time;
    });
    return alike ? 3 : 1;
}

ReducedSpeeds reduced_speeds(const JudgedRun& run, const FeedReductionRules& rules) {
    return FeedReducer(run, rules).speeds();
}

std::vector<int> gains_of(const ReducedSpeeds& reduction, const JudgedRun& run, const JudgedRun& reduced) {
    CauseMap map;
    for (std::size_t i = 0; i < reduction.causes.size(); ++i) {
        if (reduction.causes[i] >= 0)
            map.add(run.surface.positions.absolute(static_cast<PointIndex>(i)), reduction.causes[i]);
    }
    std::vector<int> gains(run.report.defects.size(), 0);
    const auto count = [&](const JudgedRun& of, int each) {
        for (const Defect& defect : of.report.defects) {
            if (const std::int32_t cause = map.near(defect.place.tip); cause >= 0)
                gains[static_cast<std::size_t>(cause)] += each;
        }
    };
    count(run, 1);
    count(reduced, -1);
    return gains;
}

}  // namespace clsurf
