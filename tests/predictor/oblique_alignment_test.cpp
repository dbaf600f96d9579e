// Comparison along an obliquity: passes slow down one after another, along an edge that is oblique to them.
#include "predictor/oblique_alignment.h"

#include <cmath>

#include <gtest/gtest.h>

#include "predictor/mismatch.h"
#include "support/made_surface.h"

namespace clsurf::oblique_alignment_test {
namespace {

constexpr double apart = 0.4, length = 40;
constexpr int passes = 21;
constexpr double dip = 0.5;   ///< share of the speed lost at the slowest place
constexpr double wide = 1.5;  ///< [mm] half width of the slow section

/// Passes along X at 50 mm/s. Each is slow around x = 20 + slope (y − 4), and the middle one again at x = 30.
test::MadeSurface made(double slope, bool fault) {
    return test::flat_zigzag(passes, length, apart, 50, {}, [=](const Vec3& flat) {
        double x = flat.x() - dip * wide * std::tanh((flat.x() - 20 - slope * (flat.y() - 4)) / wide);
        if (fault && std::abs(flat.y() - 4) < 0.01) x -= 0.3 * wide * std::tanh((flat.x() - 30) / wide);
        return Vec3(x, flat.y(), 0);
    });
}

struct Seen {
    float straight = 0, oblique = 0;  ///< largest steps of the speed
};

/// Over the cut points of the inner passes with `low` ≤ x ≤ `high`.
Seen greatest_steps(const test::MadeSurface& of, double low, double high) {
    const Signals signals = of.signals();
    const Comparer comparer(of.surface, signals, 12.5);
    Seen seen;
    std::size_t count = 0;
    for (PointIndex i = 0; i < of.surface.positions.size(); i += 3) {
        const Vec3 p = of.surface.positions.absolute(i);
        if (p.x() < low || p.x() > high || p.y() < 2.2 || p.y() > 5.8) continue;
        Comparison c = comparer.compare({i, 0});
        const float straight = c.step[index_of(Quantity::speed)];
        if (!(straight == straight)) continue;
        comparer.compare_obliquely_around({i, 0}, c);
        seen.straight = std::max(seen.straight, straight);
        seen.oblique = std::max(seen.oblique, c.step[index_of(Quantity::speed)]);
        ++count;
    }
    EXPECT_GT(count, 150U);
    return seen;
}

TEST(ObliqueComparison, PassesThatSlowDownOneAfterTheOtherAgree) {
    for (const double slope : {1.2, -1.2}) {
        const Seen seen = greatest_steps(made(slope, false), 12, 27);
        EXPECT_GT(seen.straight, 0.05F) << slope;
        EXPECT_LT(seen.oblique, 0.5F * seen.straight) << slope;
        EXPECT_LT(seen.oblique, 0.05F) << slope;
    }
}

TEST(ObliqueComparison, APassThatIsSlowByItselfStandsOutAllTheSame) {
    const Seen seen = greatest_steps(made(1.2, true), 28.5, 31.5);
    EXPECT_GT(seen.straight, 0.2F);
    EXPECT_GT(seen.oblique, 0.9F * seen.straight);
}

TEST(ObliqueComparison, IsNotLookedForWherePassesAgreeStraightAcross) {
    const test::MadeSurface of = made(0, false);
    const Signals signals = of.signals();
    const PointIndex middle = of.surface.passes[20].first + 200;
    std::vector<AdjacentPlace> places;
    for (const int aside : {1, 2, 3}) {
        places.push_back({{middle, 0}, aside});
        places.push_back({{middle, 0}, -aside});
    }
    // All places are the same one: they agree with any obliquity.
    EXPECT_FALSE(compare_obliquely(of.surface, signals, {middle, 0}, places).has_value());
    EXPECT_FALSE(compare_obliquely(of.surface, signals, {middle, 0}, std::span(places).first(3)).has_value())
        << "too few";
}

}  // namespace
}  // namespace clsurf::oblique_alignment_test
