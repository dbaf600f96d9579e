#pragma once
// The least and the greatest of many values in one call.

#include <span>

#include <Eigen/Core>

namespace clsurf {

struct Extremes {
    float least = 0;
    float greatest = 0;
};

/// NaN values are ignored; if all are NaN, both results are NaN. Vectorised. Domain: at least one value.
[[nodiscard]] inline Extremes extremes_of(std::span<const float> values) {
    const Eigen::Map<const Eigen::ArrayXf> all(values.data(), static_cast<Eigen::Index>(values.size()));
    return {all.minCoeff<Eigen::PropagateNumbers>(), all.maxCoeff<Eigen::PropagateNumbers>()};
}

}  // namespace clsurf
