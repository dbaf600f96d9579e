#include "repair/feeds/feed_equalisation.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/not_finite.h"
#include "core/parallel.h"

namespace clsurf {
namespace {

// Halvings of the interval from 0 to twice the greatest mismatch, to 0.1 % of it.
constexpr int halvings = 10;                          ///< number of halvings in the search for a step
constexpr LineNumber most_lines_between_points = 50;  ///< most lines that may be traversed between two points

/// Lowers speeds pass by pass.
class Sweep {
public:
    Sweep(const JudgedRun& run, const EqualisationStep& step, const std::vector<float>& own,
          FeedEqualisation& equalisation)
        : run_(run),
          ratio_(static_cast<float>(1 + step.share)),
          more_(static_cast<float>(step.speed)),
          ramp_(step.ramp),
          own_(own),
          speeds_(equalisation.speeds),
          causes_(equalisation.causes),
          equalised_(equalisation.equalised) {}

    void lower_point(PointIndex i, const PathLocation& left, const PathLocation& right) {
        const auto k = static_cast<std::size_t>(i);
        float& mine = speeds_[k];
        if (!(mine == mine)) return;
        std::int32_t& cause = causes_[k];
        for (const PathLocation* at : {&left, &right}) {
            if (!at->exists()) continue;
            const auto other = static_cast<std::size_t>(at->nearest());
            if (cause < 0 && causes_[other] < 0) continue;
            float ratio = ratio_;
            if (equalised_[k] == 0 && equalised_[other] == 0) ratio = std::max(ratio, own_[k] / interpolate(own_, *at));
            const float limit = ratio * interpolate(speeds_, *at) + more_;
            if (!(limit < mine)) continue;
            mine = limit;
            if (cause < 0) cause = causes_[other];
        }
    }

    /// For each section of the pass that is compared.
    void keep_to_ramps(const Pass& pass) {
        const auto end = static_cast<std::size_t>(pass.last) + 1;
        for (auto first = static_cast<std::size_t>(pass.first); first < end;) {
            std::size_t behind = first;
            while (behind < end && speeds_[behind] == speeds_[behind]) ++behind;
            if (const std::size_t count = behind - first; count > 0)
                keep_to_ramp(ramp_, run_.log.period, std::span(own_).subspan(first, count),
                             std::span(speeds_).subspan(first, count), std::span(causes_).subspan(first, count));
            first = behind + 1;
        }
    }

private:
    const JudgedRun& run_;
    float ratio_, more_;
    Ramp ramp_;
    const std::vector<float>& own_;
    std::vector<float>& speeds_;
    std::vector<std::int32_t>& causes_;
    const std::vector<std::uint8_t>& equalised_;
};

}  // namespace

std::vector<float> compared_speeds(const JudgedRun& run) {
    std::vector<float> speeds(static_cast<std::size_t>(run.surface.positions.size()), missing<float>);
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        if (run.signals.samples[i].zone != Zone::outside) speeds[i] = run.signals.samples[i].speed;
    }
    return speeds;
}

FeedEqualiser::FeedEqualiser(const JudgedRun& run)
    : run_(run), own_(compared_speeds(run)), adjacent_(own_.size()), adjacent_passes_(run.surface.passes.size()) {
    const Passes& passes = run.surface.passes;
    std::vector<std::size_t> pass_of(own_.size(), passes.size());
    for (std::size_t k = 0; k < passes.size(); ++k)
        std::fill(pass_of.begin() + passes[k].first, pass_of.begin() + passes[k].last + 1, k);
    parallel_for(static_cast<std::int64_t>(passes.size()), 1, [&](std::int64_t first, std::int64_t last) {
        for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(last); ++k) {
            std::vector<std::size_t>& others = adjacent_passes_[k];
            for (PointIndex i = passes[k].first; i <= passes[k].last; ++i) {
                const auto point = static_cast<std::size_t>(i);
                if (!(own_[point] == own_[point])) continue;
                const Eigen::Vector3f feed = run.signals.feed(i);
                adjacent_[point] = {adjacent_location(run.surface, {i, 0}, feed, Side::left),
                                    adjacent_location(run.surface, {i, 0}, feed, Side::right)};
                for (const PathLocation& at : {adjacent_[point].left, adjacent_[point].right}) {
                    if (!at.exists()) continue;
                    const std::size_t other = pass_of[static_cast<std::size_t>(at.nearest())];
                    if (other == passes.size()) continue;
                    if (std::find(others.begin(), others.end(), other) == others.end()) others.push_back(other);
                }
            }
        }
    });
}

void FeedEqualiser::equalise(const EqualisationStep& step, FeedEqualisation& equalisation) const {
    const Passes& passes = run_.surface.passes;
    std::vector<std::uint8_t> has_cause(passes.size(), 0);
    const auto update_cause = [&](std::size_t k) {
        const auto first = equalisation.causes.begin() + passes[k].first,
                   last = equalisation.causes.begin() + passes[k].last;
        has_cause[k] = std::any_of(first, last + 1, [](std::int32_t cause) { return cause >= 0; }) ? 1 : 0;
    };
    for (std::size_t k = 0; k < passes.size(); ++k) update_cause(k);
    Sweep sweep(run_, step, own_, equalisation);
    const auto over = [&](std::size_t k) {
        const Pass& pass = passes[k];
        const bool concerned =
            has_cause[k] != 0 || std::any_of(adjacent_passes_[k].begin(), adjacent_passes_[k].end(),
                                             [&](std::size_t other) { return has_cause[other] != 0; });
        if (!concerned || pass.kind != PassKind::cut) return;
        for (PointIndex i = pass.first; i <= pass.last; ++i) {
            const AdjacentLocations& at = adjacent_[static_cast<std::size_t>(i)];
            sweep.lower_point(i, at.left, at.right);
        }
        sweep.keep_to_ramps(pass);
        update_cause(k);
    };
    for (std::size_t k = 0; k < passes.size(); ++k) over(k);
    for (std::size_t k = passes.size(); k-- > 0;) over(k);
}

std::vector<float> FeedEqualiser::everywhere(const EqualisationStep& step) const {
    FeedEqualisation all{own_, std::vector<std::int32_t>(own_.size(), 0), std::vector<std::uint8_t>(own_.size(), 1)};
    equalise(step, all);
    return std::move(all.speeds);
}

double FeedEqualiser::affordable_step(const Ramp& ramp, double budget) const {
    double low = 0, high = 2 * run_.greatest_mismatch;
    for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (low + high);
        (lost(everywhere({0, middle, ramp})) > budget ? low : high) = middle;
    }
    return high;
}

double FeedEqualiser::lost(const std::vector<float>& speeds) const {
    double sum = 0;
    for (std::size_t i = 0; i < own_.size(); ++i) {
        if (speeds[i] > 0) sum += run_.log.period * (own_[i] / speeds[i] - 1);
    }
    return sum;
}

std::vector<float> peaks_by_motion(const JudgedRun& run, const Program& program, const std::vector<float>& values) {
    std::vector<float> peaks(static_cast<std::size_t>(program.motions.size()), missing<float>);
    const auto raise = [&](LineNumber line, float value) {
        for (const std::uint32_t motion : run.lines->motions_of(line)) {
            if (motion < peaks.size() && !(peaks[motion] >= value)) peaks[motion] = value;
        }
    };
    LineNumber line = 0;  // of the previous point
    float before = missing<float>;
    for (PointIndex i = 0; i < run.surface.positions.size(); ++i) {
        const float value = values[static_cast<std::size_t>(i)];
        const LineNumber here = run.lines->line_at(i);
        if (value == value) {
            if (line != 0 && here > line && here - line <= most_lines_between_points) {
                const float both = before == before ? std::max(before, value) : value;
                for (LineNumber between = line + 1; between < here; ++between) raise(between, both);
            }
            raise(here, value);
        }
        line = here;
        before = value;
    }
    return peaks;
}

std::vector<float> block_targets(std::vector<float> targets, const std::vector<std::uint8_t>& merged) {
    if (merged.empty()) return targets;
    for (auto first = targets.begin(); first != targets.end();) {
        auto last = first;
        while (last + 1 != targets.end() && merged[static_cast<std::size_t>(last - targets.begin())] != 0) ++last;
        std::fill(first, last + 1, *std::max_element(first, last + 1));
        first = last + 1;
    }
    return targets;
}

std::vector<float> equalised_feeds(const std::vector<float>& target, const std::vector<std::uint8_t>& may_slow,
                                   double width) {
    std::vector<float> feeds(target.size(), 0);
    const auto apart = static_cast<float>(1 + width);
    std::size_t first = 0;  // of the interval
    float low = 0, high = 0;
    const auto close = [&](std::size_t end) {
        if (low > 0)
            std::fill(feeds.begin() + static_cast<std::ptrdiff_t>(first),
                      feeds.begin() + static_cast<std::ptrdiff_t>(end), low);
    };
    for (std::size_t i = 0; i < target.size(); ++i) {
        if (target[i] <= 0 || (!may_slow.empty() && may_slow[i] == 0)) {
            close(i);
            low = 0;
            continue;
        }
        const bool joins = low > 0 && std::max(high, target[i]) <= apart * std::min(low, target[i]);
        if (!joins) {
            close(i);
            first = i;
            low = high = target[i];
        }
        low = std::min(low, target[i]);
        high = std::max(high, target[i]);
    }
    close(target.size());
    return feeds;
}

}  // namespace clsurf
