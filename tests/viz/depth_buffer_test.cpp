#include "viz/depth_buffer.h"

#include <gtest/gtest.h>

namespace clsurf::viz::depth_buffer_test {
namespace {

/// A square of 10 mm by 10 mm at z = 5 mm, seen from above.
class DepthBufferTest : public ::testing::Test {
protected:
    DepthBufferTest() {
        for (const float v : {0.f, 0.f, 5.f, 10.f, 0.f, 5.f, 10.f, 10.f, 5.f, 0.f, 10.f, 5.f}) square_.xyz.push_back(v);
        for (const std::uint32_t v : {0u, 1u, 2u, 0u, 2u, 3u}) square_.triangles.push_back(v);
    }
    [[nodiscard]] static Camera seen_from(double elevation) {
        return camera_for(View{0, elevation}, Box3(Vec3(-5, -5, 0), Vec3(15, 15, 10)), 400, 400, Zoom{});
    }

    Geometry square_;
};

TEST_F(DepthBufferTest, HidesWhatLiesBelowFromAbove) {
    const DepthBuffer depth(square_, seen_from(90));
    EXPECT_TRUE(depth.hides(Vec3(5, 5, 0), 0.5));
    EXPECT_TRUE(depth.hides(Vec3(9, 1, 4), 0.5));
    EXPECT_FALSE(depth.hides(Vec3(5, 5, 4.8), 0.5)) << "nearer than the tolerance";
    EXPECT_FALSE(depth.hides(Vec3(5, 5, 8), 0.5)) << "above the square";
    EXPECT_FALSE(depth.hides(Vec3(12, 5, 0), 0.5)) << "beside the square";
}

TEST_F(DepthBufferTest, ShowsTheSameFromBelow) {
    const DepthBuffer depth(square_, seen_from(-90));
    EXPECT_FALSE(depth.hides(Vec3(5, 5, 0), 0.5));
    EXPECT_TRUE(depth.hides(Vec3(5, 5, 8), 0.5));
}

TEST_F(DepthBufferTest, CoversThePicturesOfTriangles) {
    const Camera camera = seen_from(90);
    const DepthBuffer depth(square_, camera);
    EXPECT_TRUE(depth.covers(camera.pixel(Vec3(5, 5, 5))));
    EXPECT_TRUE(depth.covers(camera.pixel(Vec3(9.8, 0.2, 5))));
    EXPECT_FALSE(depth.covers(camera.pixel(Vec3(10.3, 5, 5))));
    EXPECT_FALSE(depth.covers(Vec2(-1, 5)));
    EXPECT_FALSE(depth.covers(Vec2(5, 1e9)));
}

TEST_F(DepthBufferTest, NothingIsHiddenOutsideThePicture) {
    const DepthBuffer depth(square_, seen_from(90));
    EXPECT_FALSE(depth.hides(Vec3(1000, 5, 0), 0.5));
    EXPECT_FALSE(depth.hides(Vec3(5, -1000, 0), 0.5));
}

}  // namespace
}  // namespace clsurf::viz::depth_buffer_test
