#pragma once
// LocalQuadratic: a quadratic fitted to places around a knot by weighted least squares, robust against
// outliers (bisquare weights from the residuals of the previous fit: Cleveland's local regression).

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace clsurf {

class LocalQuadratic {
public:
    /// z = a0 + a1 x + a2 y + a3 x² + a4 xy + a5 y².
    using Terms = Eigen::Matrix<double, 6, 1>;

    void clear();
    void add(double x, double y, double z, double weight);
    [[nodiscard]] std::size_t size() const { return z_.size(); }

    /// Fits three times; places that are `outlying` robust standard deviations off the previous fit have weight 0.
    /// `least_spread`: lower limit of that deviation, in units of z. Terms that the places do not determine (the slope across,
    /// if they are on one line) are near zero. At least six places. O(places).
    [[nodiscard]] Terms fit(double least_spread);

private:
    [[nodiscard]] Terms solve();
    void weigh(const Terms& a, double least_spread);

    /// One vector per member, for loops over four places at a time.
    std::vector<double> x_, y_, z_, weight_, robust_, left_, sorted_;
};

}  // namespace clsurf
