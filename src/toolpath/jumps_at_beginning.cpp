#include "toolpath/jumps_at_beginning.h"

#include <algorithm>
#include <array>
#include <vector>

namespace clsurf {

void raise_at_beginning(const AccelerationCorners& corners, const KalmanSmoother& smoother,
                        const Measurements& measured, PointIndex from, PointIndex first, Inflation& inflation) {
    constexpr std::size_t reaches = 4;
    const std::size_t n = std::min(measured.position[0].size(), reaches * static_cast<std::size_t>(smoother.reach()));
    std::array<std::array<std::vector<double>, 3>, 3> back;
    const std::array<std::array<std::span<const double>, 3>, 3> all{measured.position, measured.speed,
                                                                    measured.acceleration};
    for (std::size_t d = 0; d < 3; ++d) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (all[d][axis].size() < n) continue;
            back[d][axis].assign(all[d][axis].rend() - static_cast<std::ptrdiff_t>(n), all[d][axis].rend());
            if (d != 1) continue;
            for (double& speed : back[d][axis]) speed = -speed;
        }
    }
    std::vector<SmoothedState> states(n);
    std::vector<Eigen::Array4d> innovations(n);
    smoother.smooth({{back[0][0], back[0][1], back[0][2]},
                     {back[1][0], back[1][1], back[1][2]},
                     {back[2][0], back[2][1], back[2][2]}},
                    states, innovations);
    Inflation of_beginning;
    of_beginning.fill(std::vector<double>(n, 1.0));
    corners.raise(innovations, 0, 0, of_beginning);
    for (std::size_t d = 0; d < 4; ++d) {
        for (std::size_t k = 0; k < n; ++k) {
            const PointIndex i = from + static_cast<PointIndex>(n - 1 - k) - first;
            if (i < 0 || i >= static_cast<PointIndex>(inflation[d].size())) continue;
            double& factor = inflation[d][static_cast<std::size_t>(i)];
            factor = std::max(factor, of_beginning[d][k]);
        }
    }
}

}  // namespace clsurf
