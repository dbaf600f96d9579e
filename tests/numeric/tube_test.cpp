// The smoothest path through a tube: properties for any places.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "numeric/tube.h"

namespace clsurf::tube_test {
namespace {

constexpr double radius = 0.004;

struct Tube {
    std::vector<Vec3> places;
    std::vector<double> arc_lengths, radii;
};

/// Places on chords of a circle, `facets` per quarter, seven per facet.
Tube facetted(double r, int facets) {
    Tube tube;
    const auto corner = [&](int k) {
        return Vec3(r * std::cos(k * 1.5707963 / facets), r * std::sin(k * 1.5707963 / facets), 0);
    };
    for (int f = 0; f < facets; ++f) {
        for (int k = 0; k < 7; ++k) tube.places.push_back(corner(f) + (corner(f + 1) - corner(f)) * (k / 7.0));
    }
    tube.places.push_back(corner(facets));
    for (std::size_t i = 0; i < tube.places.size(); ++i)
        tube.arc_lengths.push_back(i == 0 ? 0 : tube.arc_lengths.back() + (tube.places[i] - tube.places[i - 1]).norm());
    tube.radii.assign(tube.places.size(), radius);
    tube.radii.front() = tube.radii.back() = 0;
    return tube;
}

double third_differences(const std::vector<Vec3>& p) {
    double sum = 0;
    for (std::size_t i = 0; i + 3 < p.size(); ++i) sum += (p[i + 3] - 3 * p[i + 2] + 3 * p[i + 1] - p[i]).squaredNorm();
    return sum;
}

TEST(Tube, KeepsInsideAndItsEnds) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1), part(0, 1);
    for (int round = 0; round < 50; ++round) {
        Tube tube;
        for (int i = 0; i < 3 + round; ++i) {
            tube.places.push_back(Vec3(0.1 * i, any(random), any(random)));
            tube.arc_lengths.push_back(i + 0.4 * part(random));
            tube.radii.push_back(i % 5 == 0 ? 0 : radius * part(random));
        }
        const std::vector<Vec3> smooth = smoothest_in_tube(tube.places, tube.arc_lengths, tube.radii, {});
        ASSERT_EQ(smooth.size(), tube.places.size());
        for (std::size_t i = 0; i < smooth.size(); ++i)
            EXPECT_LE((smooth[i] - tube.places[i]).norm(), tube.radii[i] + 1e-12);
    }
}

// A facet of 0.3 mm on a radius of 5 mm is 2.2 µm inside the circle: a tube of 4 µm contains the circle itself, whose third
// differences at a 7th of the facet are (0.3/7)³/5² = 3.1e-6 mm; those of the facets are up to 0.06 · 0.3/7 = 2.6e-3 mm.
TEST(Tube, MakesFacetsRound) {
    const Tube tube = facetted(5, 26);
    const std::vector<Vec3> smooth = smoothest_in_tube(tube.places, tube.arc_lengths, tube.radii, {});
    EXPECT_LT(third_differences(smooth), 0.01 * third_differences(tube.places));
}

// A parabola has no third differences: nothing can be improved, for any spacing.
TEST(Tube, LeavesAParabolaAlone) {
    Tube tube;
    for (int i = 0; i < 40; ++i) {
        const double s = 0.1 * i + (i % 3 == 0 ? 0.03 : 0);
        tube.arc_lengths.push_back(s);
        tube.places.push_back(Vec3(s, 0.7 * s * s - s, 0.2 * s * s));
    }
    tube.radii.assign(tube.places.size(), radius);
    const std::vector<Vec3> smooth = smoothest_in_tube(tube.places, tube.arc_lengths, tube.radii, {});
    for (std::size_t i = 0; i < smooth.size(); ++i) EXPECT_LT((smooth[i] - tube.places[i]).norm(), 1e-9) << i;
}

}  // namespace
}  // namespace clsurf::tube_test
