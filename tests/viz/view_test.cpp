#include "viz/view.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "viz/label_placer.h"

namespace clsurf::viz::view_test {
namespace {

const Box3 box(Vec3(-10, -5, 0), Vec3(10, 5, 2));

TEST(View, TopLooksDownWithYUp) {
    const Camera c = camera_for(parse_view("top"), box, 200, 100, {});
    EXPECT_TRUE(c.right.isApprox(Vec3::UnitX(), 1e-12));
    EXPECT_TRUE(c.up.isApprox(Vec3::UnitY(), 1e-12));
    EXPECT_TRUE(c.pixel(Vec3(0, 0, 1)).isApprox(Vec2(100, 50), 1e-9));
    // 20 mm on 200 pixels with a margin of 3 %.
    EXPECT_NEAR(c.pixel(Vec3(10, 0, 1)).x(), 100 + 100 / 1.03, 1e-9);
}

TEST(View, FrontLooksAlongYAndRightAlongMinusX) {
    EXPECT_TRUE(camera_for(parse_view("front"), box, 10, 10, {}).towards.isApprox(-Vec3::UnitY(), 1e-12));
    EXPECT_TRUE(camera_for(parse_view("right"), box, 10, 10, {}).towards.isApprox(Vec3::UnitX(), 1e-12));
    EXPECT_TRUE(camera_for(parse_view("90,0"), box, 10, 10, {}).towards.isApprox(Vec3::UnitX(), 1e-12));
}

TEST(View, ProjectionAndPixelAgree) {
    const Camera c = camera_for(parse_view("33,21"), box, 640, 480, {0.2, 0.1, 0.6, 0.5});
    const Vec3 p(1.5, -2.5, 0.75);
    const Projection m = c.projection();
    EXPECT_TRUE((m.leftCols<3>() * p + m.col(3)).isApprox(c.pixel(p), 1e-9));
}

TEST(View, ZoomShowsThatPartOfThePicture) {
    const Camera whole = camera_for(parse_view("top"), box, 200, 100, {});
    const Camera part = camera_for(parse_view("top"), box, 200, 100, {0.5, 0, 1, 0.5});
    // The middle of the whole picture is the lower left corner of its upper right quarter.
    const Vec3 middle(0, 0, 1);
    EXPECT_TRUE(part.pixel(middle).isApprox(Vec2(0, 0)) || part.pixel(middle).norm() < 1e-9);
    EXPECT_NEAR(part.mm_per_pixel, 0.5 * whole.mm_per_pixel, 1e-12);
}

TEST(View, FillsThePictureWithTheExtentAlongItsAxes) {
    // A square on its corner: along the axes of the view its width is exact, its box is wider.
    const ViewAxes axes = axes_of(parse_view("45,90"));
    Box3 extent;
    for (const Vec3& p : {Vec3(10, 0, 0), Vec3(0, 10, 0), Vec3(-10, 0, 0), Vec3(0, -10, 4)}) extent.extend(axes * p);
    const Camera c = camera_for(axes, extent, 100, 100, {});
    EXPECT_NEAR(c.mm_per_pixel * 100, 1.03 * 10 * std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(c.depth, 2, 1e-9);
    EXPECT_TRUE(c.shows(Vec3(10, 0, 0)));
    EXPECT_FALSE(c.shows(Vec3(10, 10, 0)));
}

TEST(View, RefusesWhatIsNone) {
    EXPECT_THROW((void)parse_view("tpo"), UsageError);
    EXPECT_THROW((void)parse_view("10"), UsageError);
    EXPECT_THROW((void)parse_view("10,95"), UsageError);
    for (const char* text : {"0,nan", "nan,0", "0,inf", "inf,0"})
        EXPECT_THROW((void)parse_view(text), UsageError) << text;
}

TEST(LabelPlacer, NoLabelLiesOnAnotherOneNorOutside) {
    const Rect panel{10, 20, 300, 200};
    LabelPlacer placer(panel);
    const Vec2 size(40, 15);
    std::vector<Rect> placed;
    // The panel has room for them, but not at the wanted place in a corner.
    for (int k = 0; k < 20; ++k) {
        const std::optional<Rect> rect = placer.place(Vec2(12, 22), size);
        ASSERT_TRUE(rect.has_value()) << k;
        EXPECT_GE(rect->x, panel.x);
        EXPECT_GE(rect->y, panel.y);
        for (const Rect& other : placed) {
            const bool apart = rect->x + rect->width < other.x || other.x + other.width < rect->x ||
                               rect->y + rect->height < other.y || other.y + other.height < rect->y;
            EXPECT_TRUE(apart) << k;
        }
        placed.push_back(*rect);
    }
    placer.take(panel);
    EXPECT_FALSE(placer.place(Vec2(150, 100), size).has_value());
}

}  // namespace
}  // namespace clsurf::viz::view_test
