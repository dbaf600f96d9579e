#include "optimize/levelling.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/not_finite.h"
#include "surface/station.h"

namespace clsurf {
namespace {

constexpr int halvings = 10;  ///< in search of a step

/// Speeds of a run, brought down pass by pass to what the passes beside it and the ramps allow.
class Leveller {
public:
    Leveller(const JudgedRun& run, const LevelStep& step, std::vector<float>& speeds, std::vector<std::int32_t>& causes)
        : run_(run),
          ratio_(static_cast<float>(1 + step.share)),
          more_(static_cast<float>(step.speed)),
          ramp_(step.ramp),
          own_(compared_speeds(run)),
          speeds_(speeds),
          causes_(causes) {}

    void sweep() {
        const Passes& passes = run_.surface.passes;
        for (std::size_t k = 0; k < passes.size(); ++k) level(passes[k]);
        for (std::size_t k = passes.size(); k-- > 0;) level(passes[k]);
    }

private:
    void level(const Pass& pass) {
        if (pass.kind != PassKind::cut) return;
        for (PointIndex i = pass.first; i <= pass.last; ++i) level(static_cast<std::size_t>(i));
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

    void level(std::size_t i) {
        float& mine = speeds_[i];
        std::int32_t& cause = causes_[i];
        if (!(mine == mine)) return;
        const auto point = static_cast<PointIndex>(i);
        for (const Side side : {Side::left, Side::right}) {
            const Station at = beside(run_.surface, {point, 0}, run_.signals.feed(point), side);
            if (!at.exists()) continue;
            const std::int32_t other_cause = causes_[static_cast<std::size_t>(at.nearest())];
            if (cause < 0 && other_cause < 0) continue;
            const auto j = static_cast<std::size_t>(at.point);
            const float other = at.fraction > 0 ? speeds_[j] + at.fraction * (speeds_[j + 1] - speeds_[j]) : speeds_[j];
            if (!(ratio_ * other + more_ < mine)) continue;
            mine = ratio_ * other + more_;
            if (cause < 0) cause = other_cause;
        }
    }

    const JudgedRun& run_;
    float ratio_, more_;
    Ramp ramp_;
    std::vector<float> own_;
    std::vector<float>& speeds_;
    std::vector<std::int32_t>& causes_;
};

}  // namespace

std::vector<float> compared_speeds(const JudgedRun& run) {
    std::vector<float> speeds(static_cast<std::size_t>(run.surface.positions.size()), missing<float>);
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        if (run.signals.samples[i].zone != Zone::outside) speeds[i] = run.signals.samples[i].speed;
    }
    return speeds;
}

void level_speeds(const JudgedRun& run, const LevelStep& step, std::vector<float>& speeds,
                  std::vector<std::int32_t>& causes) {
    Leveller(run, step, speeds, causes).sweep();
}

std::vector<float> levelled_speeds(const JudgedRun& run, const LevelStep& step) {
    std::vector<float> speeds = compared_speeds(run);
    std::vector<std::int32_t> everywhere(speeds.size(), 0);
    level_speeds(run, step, speeds, everywhere);
    return speeds;
}

double affordable_step(const JudgedRun& run, const Ramp& ramp, double budget) {
    const std::vector<float> own = compared_speeds(run);
    const auto lost = [&](double step) {
        const std::vector<float> speeds = levelled_speeds(run, {0, step, ramp});
        double sum = 0;
        for (std::size_t i = 0; i < own.size(); ++i) {
            if (speeds[i] > 0) sum += run.log.period * (own[i] / speeds[i] - 1);
        }
        return sum;
    };
    double low = 0, high = 2 * run.greatest_mismatch;
    for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (low + high);
        (lost(middle) > budget ? low : high) = middle;
    }
    return high;
}

std::vector<float> peaks_by_motion(const JudgedRun& run, const Program& program, const std::vector<float>& values) {
    std::vector<float> peaks(static_cast<std::size_t>(program.motions.size()), missing<float>);
    for (PointIndex i = 0; i < run.surface.positions.size(); ++i) {
        const float value = values[static_cast<std::size_t>(i)];
        if (!(value == value)) continue;
        for (const std::uint32_t motion : run.lines->motions_of(run.lines->line_at(i))) {
            if (motion < peaks.size() && !(peaks[motion] >= value)) peaks[motion] = value;
        }
    }
    return peaks;
}

std::vector<float> levelling_feeds(const std::vector<float>& target, const std::vector<std::uint8_t>& may_slow,
                                   double width) {
    std::vector<float> feeds(target.size(), 0);
    const auto apart = static_cast<float>(1 + width);
    std::size_t first = 0;  // of the interval
    float low = 0, high = 0;
    for (std::size_t i = 0; i < target.size(); ++i) {
        if (target[i] <= 0 || (!may_slow.empty() && may_slow[i] == 0)) {
            low = 0;
            continue;
        }
        const bool joins = low > 0 && std::max(high, target[i]) <= apart * std::min(low, target[i]);
        if (!joins) {
            first = i;
            low = high = target[i];
        }
        low = std::min(low, target[i]);
        high = std::max(high, target[i]);
        std::fill(feeds.begin() + static_cast<std::ptrdiff_t>(first),
                  feeds.begin() + static_cast<std::ptrdiff_t>(i) + 1, low);
    }
    return feeds;
}

}  // namespace clsurf
