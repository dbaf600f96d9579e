#include "viz/surface_extent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/block.h"

namespace clsurf::viz {
namespace {

/// Passes of different lengths on a wavy surface, rapids that extend farther between them, and a point without a position.
ClSurface wavy() {
    ClSurface surface;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> noise(-0.01F, 0.01F);
    constexpr PointIndex count = 6 * block_points + 123;
    for (PointIndex i = 0; i < count; ++i) {
        const auto t = static_cast<float>(i) / 5000.0F;
        surface.positions.x.push_back(40 * std::sin(t) + noise(random));
        surface.positions.y.push_back(0.8F * t + noise(random));
        surface.positions.z.push_back(3 * std::cos(0.7F * t) + noise(random));
    }
    surface.positions.origin = {100, -50, 7};
    surface.positions.z[5] = std::nanf("");
    for (PointIndex first = 0; first < count;) {
        const PointIndex last = std::min(count - 1, first + 300 + first % 7000);
        surface.passes.push_back({first, last, surface.passes.size() % 9 == 4 ? PassKind::rapid : PassKind::cut});
        first = last + 1;
    }
    return surface;
}

/// The boxes of a surface's blocks, as in a survey.
std::vector<Eigen::AlignedBox3f> boxes_of(const ClSurface& surface) {
    std::vector<Eigen::AlignedBox3f> boxes(static_cast<std::size_t>(surface.positions.size() / block_points + 1));
    for (const Pass& pass : surface.passes) {
        for (PointIndex i = pass.first; pass.kind == PassKind::cut && i <= pass.last; ++i) {
            if (surface.positions[i].allFinite())
                boxes[static_cast<std::size_t>(i / block_points)].extend(surface.positions[i]);
        }
    }
    return boxes;
}

TEST(SurfaceExtent, IsTheSameByTheBoxesOfBlocks) {
    const ClSurface whole = wavy();
    ClSurface by_boxes = wavy();
    by_boxes.surface_boxes = boxes_of(by_boxes);
    for (const View view : {View{45, 35}, View{0, 90}, View{0, 0}, View{123, -12}}) {
        const Box3 expected = extent_of(whole, axes_of(view)), found = extent_of(by_boxes, axes_of(view));
        EXPECT_EQ(found.min(), expected.min()) << view.azimuth;
        EXPECT_EQ(found.max(), expected.max()) << view.azimuth;
    }
}

}  // namespace
}  // namespace clsurf::viz
