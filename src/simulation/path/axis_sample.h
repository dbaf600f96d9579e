#pragma once
// AxisSample: the derivatives of a path at one place, for each of the axes that move along it.

#include <limits>

#include <Eigen/Core>

#include "simulation/path/path_stream.h"

namespace clsurf {

inline constexpr double infinite_speed = std::numeric_limits<double>::infinity();

/// A value for each axis that moves along the path.
template <int Axes>
using AxisVector = Eigen::Matrix<double, Axes, 1>;

/// The derivatives of a curved path by arc length; rotary axes in rad.
template <int Axes>
struct AxisSample {
    using Vector = AxisVector<Axes>;
    double at = 0;  ///< arc length after the start of the cell [mm]
    Vector first = Vector::Zero(), second = Vector::Zero(), third = Vector::Zero();  ///< x′, x″ [1/mm], x‴ [1/mm²]
    Pace pace{0, 0, 0};           ///< 0: the cell's own limits along the path are enough
    double cap = infinite_speed;  ///< speed limit of the bend at this place [mm/s]
};
using PathSample = AxisSample<3>;

}  // namespace clsurf
