#include "viz/label_placer.h"

#include <gtest/gtest.h>

namespace clsurf::viz::label_placer_test {
namespace {

bool meets(const Rect& a, const Rect& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

TEST(LabelPlacer, ALineToALabelCrossesNoOtherLabel) {
    LabelPlacer placer({0, 0, 600, 400});
    const Vec2 anchor(300, 200), wanted(300, 215), size(80, 24);
    const Rect first = placer.place(wanted, size, anchor).value();
    const Rect second = placer.place(wanted, size, anchor).value();
    EXPECT_FALSE(meets(first, second));
    const Vec2 end = nearest_in(second, anchor);
    for (double share = 0; share <= 1; share += 0.02) {
        const Vec2 at = anchor + share * (end - anchor);
        EXPECT_FALSE(meets(first, {at.x(), at.y(), 0, 0})) << share;
    }
    // A later label does not overlap a line either.
    placer.take_line(anchor, Vec2(300, 20));
    const Rect third = placer.place(Vec2(300, 100), size).value();
    EXPECT_TRUE(third.x > 300 || third.x + third.width < 300);
}

TEST(LabelPlacer, ALabelWithoutAFreeLineIsPlacedAllTheSame) {
    LabelPlacer placer({0, 0, 600, 400});
    const Vec2 anchor(300, 200);
    placer.take({280, 180, 40, 40});
    EXPECT_TRUE(placer.place(anchor, Vec2(80, 24), anchor).has_value());
}

}  // namespace
}  // namespace clsurf::viz::label_placer_test
