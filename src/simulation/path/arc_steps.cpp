#include "simulation/path/arc_steps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/not_finite.h"
#include "simulation/path/junction.h"

namespace clsurf {
namespace {

constexpr int places = 8;  ///< number of places at which the curvature is evaluated within the time

}  // namespace

ArcSteps::ArcSteps(const Machine& machine) : period_(machine.controller.period), jerk_(Vec3::Constant(infinite)) {
    if (!only_path_jerk(machine)) time_ = machine.controller.arc_step_time;
    for (int i = 0; i < 3; ++i) {
        const double limit = machine.axes[static_cast<std::size_t>(i)].max_jerk;
        if (limit > 0) jerk_[i] = limit;
    }
}

double ArcSteps::speed(const Vec3& change) const {
    const double greatest = (change.cwiseAbs().array() / jerk_.array()).maxCoeff();
    return greatest > 0 ? std::sqrt(time_ / greatest) : infinite;
}

double ArcSteps::speed(const PathElement& arc, const Vec3& before, const Vec3& after) const {
    const Vec3 at_begin = arc.second_derivative(0) - before, at_end = after - arc.second_derivative(arc.length);
    // The steps alone limit the speed, and at that limit the arc turns most within the time.
    const double turned = std::min(arc.length, speed(at_begin.cwiseAbs().cwiseMax(at_end.cwiseAbs())) * time_);
    std::array<Vec3, 2> low{before, after}, high{before, after};
    for (int k = 0; k <= places; ++k) {
        const double at = turned * k / places;
        const std::array<Vec3, 2> bend{arc.second_derivative(at), arc.second_derivative(arc.length - at)};
        for (std::size_t end = 0; end < 2; ++end) {
            low[end] = low[end].cwiseMin(bend[end]);
            high[end] = high[end].cwiseMax(bend[end]);
        }
    }
    if (turned < arc.length) return speed((high[0] - low[0]).cwiseMax(high[1] - low[1]));
    return speed(high[0].cwiseMax(after) - low[0].cwiseMin(after));
}

}  // namespace clsurf
