#include "pipeline/motion_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "core/block.h"
#include "core/statistics.h"
#include "field/field_set.h"
#include "field/position_fields.h"
#include "predictor/quality_fields.h"

namespace clsurf {
namespace {

constexpr double share_below = 0.95;

struct Spreads {
    double percentile = missing<double>, rms = missing<double>;
};

Spreads spreads_of(std::vector<float>& sizes) {
    if (sizes.empty()) return {};
    SumOfSquares squares;
    for (const float size : sizes) squares.add(size);
    return {quantile_below(sizes, share_below), std::sqrt(squares.value() / static_cast<double>(sizes.size()))};
}

/// The passes around some points, as far as derivatives there may depend on them.
Passes passes_about(const Passes& passes, const PointRange& points) {
    constexpr PointIndex reach = 8192;
    Passes about;
    for (const Pass& pass : passes) {
        const Pass clipped{std::max(pass.first, points.first - reach), std::min(pass.last, points.last + reach),
                           pass.kind};
        if (clipped.size() > 0) about.push_back(clipped);
    }
    return about;
}

void add_jerks(const Passes& passes, const PointRange& points, const Column<float>& jerks, Distribution& sizes) {
    for (const Pass& pass : passes) {
        if (pass.kind != PassKind::cut) continue;
        for (PointIndex i = std::max(pass.first, points.first); i <= std::min(pass.last, points.last); ++i) {
            const float value = jerks[static_cast<std::size_t>(i - points.first)];
            if (std::isfinite(value)) sizes.add(value);
        }
    }
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
        if (std::isfinite(value)) sizes.push_back(std::abs(value));
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
            if (std::isfinite(value)) sizes.push_back(value);
        }
    }
    const Spreads jerks = spreads_of(sizes);
    quality.jerk = jerks.percentile;
    quality.jerk_rms = jerks.rms;
    return quality;
}

MotionSizes motion_sizes(const Log& log, const Trajectory& path, const ClSurface& surface, const Signals& signals,
                         const PointRange& points) {
    constexpr PointIndex at_once = 64 * block_points;
    const Passes passes = passes_about(surface.passes, points);
    const PositionFields fields(log, path, passes);
    MotionSizes sizes;
    for (PointIndex first = points.first; first <= points.last; first += at_once) {
        const PointRange some{first, std::min(points.last, first + at_once - 1)};
        for (const float value : speed_differences(surface, signals, some)) {
            if (std::isfinite(value)) sizes.mismatch.add(std::abs(value));
        }
        constexpr std::array<std::string_view, 1> jerk{"jerk"};
        add_jerks(passes, some, fields.compute(jerk, some).front().values, sizes.jerk);
    }
    return sizes;
}

MotionQuality motion_quality(const MotionSizes& sizes, const ClSurface& surface, double period) {
    MotionQuality quality;
    quality.duration = time_in_motion(surface, period);
    quality.mismatch = sizes.mismatch.quantile_below(share_below);
    quality.mismatch_rms = sizes.mismatch.rms();
    quality.jerk = sizes.jerk.quantile_below(share_below);
    quality.jerk_rms = sizes.jerk.rms();
    return quality;
}

}  // namespace clsurf
