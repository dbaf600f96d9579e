#include "log/held_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/block.h"

namespace clsurf {
namespace {

struct Samples {
    std::vector<double> times, values;  ///< in ascending order of time
};

/// Times of records [begin, begin + out.size()) [s].
void copy_times(const Log& log, PointIndex begin, std::span<double> out) {
    if (const Channel* time = log.find("time")) {
        copy_block(time->values, begin, out);
        return;
    }
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = static_cast<double>(begin + static_cast<PointIndex>(i)) * log.period;
}

Samples samples_of(const Log& log, const Channel& channel) {
    std::vector<double> times(static_cast<std::size_t>(log.records)), values(times.size());
    copy_times(log, 0, times);
    copy_block(channel.values, 0, values);
    Samples samples;
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (!std::isfinite(values[i]) || !std::isfinite(times[i])) continue;
        if (!samples.times.empty() && times[i] <= samples.times.back()) continue;
        samples.times.push_back(times[i]);
        samples.values.push_back(values[i]);
    }
    return samples;
}

}  // namespace

std::vector<double> held_values(const Log& slow, const Channel& channel, const Log& fast, const HoldRule& rule) {
    const Samples samples = samples_of(slow, channel);
    std::vector<double> held(static_cast<std::size_t>(fast.records), std::numeric_limits<double>::quiet_NaN());
    for_each_block(fast.records, [&](PointIndex first, PointIndex last) {
        std::vector<double> times(static_cast<std::size_t>(last - first));
        copy_times(fast, first, times);
        for (std::size_t i = 0; i < times.size(); ++i) {
            const double time = times[i] + rule.offset;
            // NaN is after every sample, and beyond any age.
            const auto after = std::upper_bound(samples.times.begin(), samples.times.end(), time);
            if (after == samples.times.begin()) continue;
            const std::size_t k = static_cast<std::size_t>(after - samples.times.begin()) - 1;
            if (time - samples.times[k] <= rule.age) held[static_cast<std::size_t>(first) + i] = samples.values[k];
        }
    });
    return held;
}

}  // namespace clsurf
