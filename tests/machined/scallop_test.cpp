#include "machined/scallop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "support/scallop_roughness.h"

namespace clsurf::scallop_test {
namespace {

constexpr double flat = std::numeric_limits<double>::infinity();

struct Case {
    double ball, step_over, rho, height, ra, rq;
};

// Computed independently with 50 digits from the circles themselves.
constexpr Case cases[] = {
    {1.0, 0.426, flat, 0.0229478007803, 0.0058884084257, 0.00684171233052},
    {2.0, 0.239, -30.0, 0.0033344808839, 0.000855628193745, 0.000994150123476},
    {5.0, 0.246, flat, 0.00151312895592, 0.000388269071121, 0.000451127893889},
    {2.0, 0.336, 20.0, 0.00777988785535, 0.00199632015447, 0.00231951441359},
    {3.0, 0.122, 8.0, 0.000852953735228, 0.000218868030507, 0.000254301671151},
    {5.0, 0.176, -12.0, 0.000451742808121, 0.00011591725861, 0.000134683683641},
    {3.0, 0.232, 20.0, 0.00258053098455, 0.00066216455937, 0.000769365693266},
    {5.0, 0.499, -30.0, 0.00518940617738, 0.00133160224598, 0.00154718199673},
};

TEST(Scallop, IsThatOfTheCircles) {
    for (const Case& c : cases) {
        const double h = scallop_height(c.ball, c.step_over, c.rho);
        EXPECT_NEAR(h, c.height, 1e-9 + 1e-6 * c.height);
        EXPECT_NEAR(test::scallop_ra(h), c.ra, 1e-9 + 1e-6 * c.ra);
        EXPECT_NEAR(test::scallop_rq(h), c.rq, 1e-9 + 1e-6 * c.rq);
    }
}

TEST(Scallop, OfAGentleCurveIsBetweenTheParabolas) {
    // a²/8 (1/r ± 1/ρ), and (a/2)⁴ / 8r³ = 3e-8 that the parabola neglects.
    EXPECT_NEAR(scallop_height(3, 0.1, 1e3), 0.01 / 8 * (1 / 3.0 + 1e-3), 5e-8);
    EXPECT_NEAR(scallop_height(3, 0.1, -1e3), 0.01 / 8 * (1 / 3.0 - 1e-3), 5e-8);
}

TEST(Scallop, RefusesWhatCannotBeCut) {
    EXPECT_THROW((void)scallop_height(3, 6, flat), std::domain_error);     // passes do not meet
    EXPECT_THROW((void)scallop_height(3, 0.3, -2.9), std::domain_error);   // gouges
    EXPECT_THROW((void)scallop_height(0.3, 0.5, 0.3), std::domain_error);  // too convex to meet
    EXPECT_THROW((void)scallop_height(0, 0.3, flat), std::domain_error);
}

}  // namespace
}  // namespace clsurf::scallop_test
