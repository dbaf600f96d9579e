#include "tradeoff/settings_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "core/parallel.h"
#include "pipeline/judge.h"
#include "pipeline/simulated_log.h"
#include "predictor/quality_fields.h"

namespace clsurf {
namespace {

constexpr std::array jerk_steps{0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.42, 0.35, 0.3, 0.25};
constexpr std::array acceleration_steps{0.9, 0.8, 0.7, 0.6, 0.5, 0.42, 0.35, 0.3, 0.25};
constexpr std::array feed_steps{0.95, 0.9, 0.85, 0.8, 0.75, 0.7, 0.65, 0.6, 0.55, 0.5};
constexpr std::size_t most_at_once = 8;  ///< runs in one round between neighbours on the front
constexpr double whole_percent = 100;

double geometric_mean(double a, double b) { return std::round(std::sqrt(a * b) * whole_percent) / whole_percent; }

PlanSettings strictest(const PlanSettings& a, const PlanSettings& b) {
    return {std::min(a.jerk, b.jerk), std::min(a.acceleration, b.acceleration), std::min(a.feed, b.feed),
            a.intervals || b.intervals};
}

PlanSettings geometric_mean(const PlanSettings& a, const PlanSettings& b) {
    return {geometric_mean(a.jerk, b.jerk), geometric_mean(a.acceleration, b.acceleration),
            geometric_mean(a.feed, b.feed), a.intervals && b.intervals};
}

class SettingsSearch {
public:
    SettingsSearch(const Program& program, const Machine& machine, const MachineOfSettings& machine_of,
                   const PartRules& judging, const SettingsRules& rules, const Progress& progress)
        : program_(program),
          machine_(machine),
          machine_of_(machine_of),
          judging_(judging),
          rules_(rules),
          progress_(progress),
          prepared_(program),
          zero_(prepare_run(prepared_, machine, judging.poses, rules.start).translation()) {
        judging_.identity = ProgramIdentity::same;
        judging_.limits.clear();
        if (!runs_on_five_axes(program, machine)) judging_.kinematics = nullptr;
    }

    SettingsTradeoff run() {
        try_all({PlanSettings{}});
        if (!rows_.front().on_front)  // time, mismatch or jerk is unknown
            throw InputError(Place::of_file(program_.main().name()),
                             "has no adjacent passes: there is no mismatch to trade time for");
        try_each_alone();
        while (room() > 0) {
            std::vector<PlanSettings> wanted = between_neighbours();
            if (wanted.empty()) break;
            try_all(wanted);
        }
        return sorted();
    }

private:
    [[nodiscard]] std::size_t room() const {
        return static_cast<std::size_t>(std::max(0, rules_.runs)) - std::min<std::size_t>(tried_.size(), rules_.runs);
    }
    [[nodiscard]] bool in_time(const TradeoffRow& row) const {
        return row.quality.duration <= rows_.front().quality.duration * (1 + rules_.more_time);
    }
    [[nodiscard]] bool is_new(const PlanSettings& settings) const {
        return std::ranges::find(tried_, settings) == tried_.end();
    }

    [[nodiscard]] TradeoffRow run_with(const PlanSettings& settings) const {
        const Machine machine = machine_of_(settings);
        SimulatedRun run = simulate_to_log(prepared_, machine, rules_.start, {}, zero_);
        const Part part = assemble(program_, std::move(run.log), judging_);
        const ClSurface surface = stitch(part);
        const PartSignals signals = signals_of(part, surface);
        const QualityReport report = find_defects(part, surface, signals);
        return row_of(text_of(settings),
                      motion_quality(part.log, part.path, surface, speed_differences(surface, signals.signals),
                                     estimate_motion(part, surface.passes)),
                      report);
    }

    /// Tries settings; returns for each whether it is in time. Settings beyond the greatest number of runs count as not in
    /// time.
    std::vector<bool> try_all(std::span<const PlanSettings> wanted) {
        const std::size_t count = std::min(wanted.size(), room());
        std::vector<TradeoffRow> made(count);
        if (progress_)
            progress_("simulate settings", static_cast<double>(tried_.size()) / static_cast<double>(rules_.runs));
        parallel_for(static_cast<std::int64_t>(count), 1, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t i = first; i < last; ++i) {
                const auto k = static_cast<std::size_t>(i);
                made[k] = run_with(wanted[k]);
            }
        });
        std::vector<bool> kept(wanted.size(), false);
        for (std::size_t k = 0; k < count; ++k) {
            tried_.push_back(wanted[k]);
            if (!rows_.empty() && !in_time(made[k])) continue;
            kept[k] = true;
            settings_.push_back(wanted[k]);
            rows_.push_back(std::move(made[k]));
        }
        mark_front(rows_);
        return kept;
    }
    std::vector<bool> try_all(std::initializer_list<PlanSettings> wanted) {
        return try_all(std::span(wanted.begin(), wanted.size()));
    }

    /// Varies each setting alone, step by step, until the run takes too long.
    void try_each_alone() {
        struct Ladder {
            double PlanSettings::*share;
            std::span<const double> steps;
        };
        std::vector<Ladder> ladders{{&PlanSettings::feed, feed_steps},
                                    {&PlanSettings::acceleration, acceleration_steps}};
        if (limits_jerk(machine_)) ladders.insert(ladders.begin(), {&PlanSettings::jerk, jerk_steps});
        bool intervals = machine_.controller.feed == FeedRule::programmed;
        while (room() > 0 && !(ladders.empty() && !intervals)) {
            std::vector<PlanSettings> wanted;
            for (const Ladder& ladder : ladders) { wanted.emplace_back().*ladder.share = ladder.steps.front(); }
            if (intervals) wanted.emplace_back().intervals = true;
            intervals = false;
            const std::vector<bool> kept = try_all(wanted);
            std::vector<Ladder> left;
            for (std::size_t k = 0; k < ladders.size(); ++k) {
                if (kept[k] && ladders[k].steps.size() > 1)
                    left.push_back({ladders[k].share, ladders[k].steps.subspan(1)});
            }
            ladders = std::move(left);
        }
    }

    /// New settings between neighbours on the front, those with the widest gap first.
    [[nodiscard]] std::vector<PlanSettings> between_neighbours() const {
        std::vector<std::size_t> front;
        for (std::size_t row = 0; row < rows_.size(); ++row) {
            if (rows_[row].on_front) front.push_back(row);
        }
        std::ranges::stable_sort(front, {}, [&](std::size_t row) { return rows_[row].quality.duration; });
        struct Gap {
            double width;
            std::size_t a, b;
        };
        std::vector<Gap> gaps;
        for (std::size_t k = 1; k < front.size(); ++k)
            gaps.push_back({width(front[k - 1], front[k]), front[k - 1], front[k]});
        std::ranges::stable_sort(gaps, std::ranges::greater{}, &Gap::width);
        std::vector<PlanSettings> wanted;
        for (const Gap& gap : gaps) {
            const PlanSettings &a = settings_[gap.a], &b = settings_[gap.b];
            for (const PlanSettings& between : {geometric_mean(a, b), strictest(a, b)}) {
                if (!is_new(between) || std::ranges::find(wanted, between) != wanted.end()) continue;
                if (wanted.size() < most_at_once) wanted.push_back(between);
            }
        }
        return wanted;
    }

    /// Distance between two rows, relative to the values of the machine file.
    [[nodiscard]] double width(std::size_t a, std::size_t b) const {
        const MotionQuality &p = rows_[a].quality, &q = rows_[b].quality, &reference = rows_.front().quality;
        const auto apart = [](double x, double y, double unit) { return unit > 0 ? std::abs(x - y) / unit : 0; };
        return std::hypot(apart(p.duration, q.duration, reference.duration),
                          apart(p.mismatch, q.mismatch, reference.mismatch), apart(p.jerk, q.jerk, reference.jerk));
    }

    [[nodiscard]] SettingsTradeoff sorted() {
        std::vector<std::size_t> order(rows_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin() + 1, order.end(), [&](std::size_t a, std::size_t b) {
            return rows_[a].quality.duration < rows_[b].quality.duration;
        });
        SettingsTradeoff result;
        for (const std::size_t row : order) {
            result.front.rows.push_back(std::move(rows_[row]));
            result.settings.push_back(settings_[row]);
        }
        return result;
    }

    const Program& program_;
    const Machine& machine_;
    const MachineOfSettings& machine_of_;
    PartRules judging_;
    const SettingsRules& rules_;
    const Progress& progress_;
    Program prepared_;  ///< as it is simulated
    Vec3 zero_;
    std::vector<TradeoffRow> rows_;  ///< in time, in the order of the trials
    std::vector<PlanSettings> settings_;
    std::vector<PlanSettings> tried_;
};

}  // namespace

SettingsTradeoff search_settings(const Program& program, const Machine& machine, const MachineOfSettings& machine_of,
                                 const PartRules& judging, const SettingsRules& rules, const Progress& progress) {
    return SettingsSearch(program, machine, machine_of, judging, rules, progress).run();
}

}  // namespace clsurf
