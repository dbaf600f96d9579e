#include "optimize/levelling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "surface/station.h"

namespace clsurf {
namespace {

constexpr int halvings = 10;  ///< in search of a step

}  // namespace

std::vector<float> compared_speeds(const JudgedRun& run) {
    std::vector<float> speeds(static_cast<std::size_t>(run.surface.positions.size()),
                              std::numeric_limits<float>::quiet_NaN());
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        if (run.signals.samples[i].zone != Zone::outside) speeds[i] = run.signals.samples[i].speed;
    }
    return speeds;
}

void level_speeds(const JudgedRun& run, const LevelStep& step, std::vector<float>& speeds,
                  std::vector<std::int32_t>& causes) {
    const auto ratio = static_cast<float>(1 + step.share), more = static_cast<float>(step.speed);
    const auto level = [&](PointIndex i) {
        float& mine = speeds[static_cast<std::size_t>(i)];
        std::int32_t& cause = causes[static_cast<std::size_t>(i)];
        if (!(mine == mine)) return;
        for (const Side side : {Side::left, Side::right}) {
            const Station at = beside(run.surface, {i, 0}, run.signals.feed(i), side);
            if (!at.exists()) continue;
            const std::int32_t other_cause = causes[static_cast<std::size_t>(at.nearest())];
            if (cause < 0 && other_cause < 0) continue;
            const auto j = static_cast<std::size_t>(at.point);
            const float other = at.fraction > 0 ? speeds[j] + at.fraction * (speeds[j + 1] - speeds[j]) : speeds[j];
            if (!(ratio * other + more < mine)) continue;
            mine = ratio * other + more;
            if (cause < 0) cause = other_cause;
        }
    };
    const auto count = static_cast<PointIndex>(speeds.size());
    for (PointIndex i = 0; i < count; ++i) level(i);
    for (PointIndex i = count; i-- > 0;) level(i);
}

std::vector<float> levelled_speeds(const JudgedRun& run, const LevelStep& step) {
    std::vector<float> speeds = compared_speeds(run);
    std::vector<std::int32_t> everywhere(speeds.size(), 0);
    level_speeds(run, step, speeds, everywhere);
    return speeds;
}

double affordable_step(const JudgedRun& run, double budget) {
    const std::vector<float> own = compared_speeds(run);
    const auto lost = [&](double step) {
        const std::vector<float> speeds = levelled_speeds(run, {0, step});
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

std::vector<float> means_by_motion(const JudgedRun& run, const Program& program, const std::vector<float>& values) {
    const auto count = static_cast<std::size_t>(program.motions.size());
    std::vector<float> sum(count, 0);
    std::vector<std::uint32_t> points(count, 0);
    for (PointIndex i = 0; i < run.surface.positions.size(); ++i) {
        const float value = values[static_cast<std::size_t>(i)];
        if (!(value == value)) continue;
        for (const std::uint32_t motion : run.lines->motions_of(run.lines->line_at(i))) {
            if (motion >= count) continue;
            sum[motion] += value;
            ++points[motion];
        }
    }
    for (std::size_t i = 0; i < count; ++i)
        sum[i] = points[i] > 0 ? sum[i] / static_cast<float>(points[i]) : std::numeric_limits<float>::quiet_NaN();
    return sum;
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
