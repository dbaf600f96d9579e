// Bands over few vertices, as in a page: the area between passes remains closed.
#include "viz/bands.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "support/stitched_path.h"

namespace clsurf::viz::bands_test {
namespace {

constexpr int passes = 40;
constexpr double length = 60;
constexpr double apart = 0.1;
constexpr double step = 0.02;

double area_of(const ClSurface& surface, const SectionVertices& vertices, const Bands& bands) {
    const auto at = [&](std::size_t k) -> Vec3 {
        return surface.positions[vertices.points[bands.triangles[k]]].cast<double>();
    };
    double area = 0;
    for (std::size_t k = 0; k < bands.triangles.size(); k += 3) {
        const Vec3 a = at(k);
        area += 0.5 * Vec3(at(k + 1) - a).cross(Vec3(at(k + 2) - a)).norm();
    }
    return area;
}

TEST(Bands, FewVerticesFarApartLeaveNothingOpen) {
    const ClSurface surface = test::surface_of(test::zigzag(passes, length, apart, step), apart);
    std::mt19937 random(3);
    for (const double longest : {0.1, 0.6, 1.2, 2.4}) {  // mm between vertices, up to 24 step-overs
        std::vector<PointIndex> points;
        for (const Pass& pass : surface.passes) {
            // Extremes of fields are anywhere: steps from one point to the longest, two of which often coincide.
            std::uniform_int_distribution<PointIndex> stride(1, static_cast<PointIndex>(longest / step));
            for (PointIndex i = pass.first; i < pass.last; i += random() % 3 == 0 ? 1 : stride(random))
                points.push_back(i);
            points.push_back(pass.last);
        }
        const SectionVertices vertices = section_vertices(surface, points);
        const Bands bands = join_passes(surface, vertices, NearnessFrame(), std::numeric_limits<float>::max());
        const double whole = length * apart * (passes - 1);
        EXPECT_NEAR(area_of(surface, vertices, bands), whole, 0.005 * whole) << longest;
    }
}

}  // namespace
}  // namespace clsurf::viz::bands_test
