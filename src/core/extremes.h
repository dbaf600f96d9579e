#pragma once
// The least and the greatest of many values at once.

#include <span>

#include <Eigen/Core>

namespace clsurf {

struct Extremes {
    float least = 0;
    float greatest = 0;
};

/// Values that are not known (NaN) do not count; all of them: both are NaN. Side by side, as the processor compares them.
/// Domain: at least one value.
[[nodiscard]] inline Extremes extremes_of(std::span<const float> values) {
    const Eigen::Map<const Eigen::ArrayXf> all(values.data(), static_cast<Eigen::Index>(values.size()));
    return {all.minCoeff<Eigen::PropagateNumbers>(), all.maxCoeff<Eigen::PropagateNumbers>()};
}

}  // namespace clsurf
