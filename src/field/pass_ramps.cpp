#include "field/pass_ramps.h"

#include <algorithm>
#include <cmath>

namespace clsurf {
namespace {

constexpr double rise_seconds = 0.005;  ///< interval within which a ramp …
constexpr float least_rise = 0.02F;     ///< … must become faster by this share
constexpr double longest_fall = 0.05;   ///< [s] longest time for which a pass may brake before its ramp
constexpr float least_gain = 0.1F;      ///< least share by which the end of a ramp exceeds its slowest point

/// Number of points of the ramp that begins at `end` and extends inwards.
PointIndex ramp_length(const Column<float>& speed, PointIndex end, int direction, PointIndex count, double period) {
    const auto at = [&](PointIndex k) { return speed[static_cast<std::size_t>(end + direction * k)]; };
    const PointIndex stride = std::max<PointIndex>(1, std::lround(rise_seconds / period));
    const PointIndex fall = std::min<PointIndex>(count, std::lround(longest_fall / period));
    PointIndex slowest = 0;
    for (PointIndex k = 1; k < fall; ++k) {
        if (at(k) < at(slowest)) slowest = k;
    }
    PointIndex length = slowest;
    while (length + stride < count && at(length + stride) > (1 + least_rise) * at(length)) length += stride;
    return length < count && at(length) > (1 + least_gain) * at(slowest) ? length : 0;
}

}  // namespace

std::vector<PointRange> pass_ramps(const Field& speed, const Passes& passes, double period) {
    std::vector<PointRange> ramps;
    for (const Pass& pass : passes) {
        if (pass.kind == PassKind::link) ramps.push_back({pass.first, pass.last});
        if (pass.kind != PassKind::cut) continue;
        const PointIndex after = ramp_length(speed.values, pass.first, 1, pass.size(), period);
        const PointIndex before = ramp_length(speed.values, pass.last, -1, pass.size() - after, period);
        if (after > 0) ramps.push_back({pass.first, pass.first + after - 1});
        if (before > 0) ramps.push_back({pass.last - before + 1, pass.last});
    }
    return ramps;
}

}  // namespace clsurf
