#include "pipeline/motion_quality.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/statistics.h"
#include "field/field_set.h"

namespace clsurf {
namespace {

constexpr double share_below = 0.95;

struct Spreads {
    double percentile = missing<double>, rms = missing<double>;
};

Spreads spreads_of(std::vector<float>& sizes) {
    if (sizes.empty()) return {};
    double squares = 0;
    for (const float size : sizes) squares += static_cast<double>(size) * static_cast<double>(size);
    return {quantile_below(sizes, share_below), std::sqrt(squares / static_cast<double>(sizes.size()))};
}

}  // namespace

double time_in_motion(const ClSurface& surface, double period) {
    const PointIndex count = surface.positions.size();
    PointIndex first = 0, last = count - 1;
    const auto rests = [&](PointIndex a, PointIndex b) {
        return surface.positions.absolute(a) == surface.positions.absolute(b);
    };
    while (first < last && rests(first, first + 1)) ++first;
    while (last > first && rests(last, last - 1)) --last;
    return static_cast<double>(std::max<PointIndex>(0, last - first)) * period;
}

MotionQuality motion_quality(const Log& log, const Trajectory& path, const ClSurface& surface,
                             const Column<float>& speed_differences, std::shared_ptr<const MotionEstimate> estimate) {
    MotionQuality quality;
    quality.duration = time_in_motion(surface, log.period);
    std::vector<float> sizes;
    for (const float value : speed_differences) {
        if (value == value) sizes.push_back(std::abs(value));
    }
    const Spreads mismatch = spreads_of(sizes);
    quality.mismatch = mismatch.percentile;
    quality.mismatch_rms = mismatch.rms;
    const Field jerk = FieldSet(log, path, surface.passes, {std::move(estimate), 0}).get("jerk");
    sizes.clear();
    for (const Pass& pass : surface.passes) {
        if (pass.kind != PassKind::cut) continue;
        for (PointIndex i = pass.first; i <= pass.last; ++i) {
            const float value = jerk.values[static_cast<std::size_t>(i)];
            if (value == value) sizes.push_back(value);
        }
    }
    const Spreads jerks = spreads_of(sizes);
    quality.jerk = jerks.percentile;
    quality.jerk_rms = jerks.rms;
    return quality;
}

}  // namespace clsurf
