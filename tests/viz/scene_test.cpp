#include "viz/scene.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/stitched_path.h"
#include "viz/field_colours.h"

namespace clsurf::viz::scene_test {
namespace {

TEST(Scene, TheLegendPointsToTheValueOfASinglePoint) {
    // At least ten points in each pixel.
    const ClSurface surface = test::surface_of(test::zigzag(21, 10, 0.5, 0.001), 0.5);
    Field field;
    field.values = Column<float>(static_cast<std::size_t>(surface.positions.size()), 1.0F);
    Look look;
    look.width = 600;
    look.height = 450;
    look.view = parse_view("top");
    MapPanel panel;
    panel.surface = &surface;
    panel.field = &field;
    const ColourScale scale = scale_of(field.info, 0, 5);
    const auto points_up = [&] {
        const Sheet sheet = map_sheet({panel}, placed_map({panel}, look), scale, {}, look);
        return std::any_of(sheet.quads.begin(), sheet.quads.end(),
                           [&](const FlatQuad& quad) { return quad.rgb == scale.map.above(); });
    };
    EXPECT_FALSE(points_up());
    field.values[105'000] = 9;
    EXPECT_TRUE(points_up()) << "the mean of its pixel is within the range";
    look.zoom = {0, 0, 0.2, 0.2};
    EXPECT_FALSE(points_up()) << "it is not in the picture";
}

}  // namespace
}  // namespace clsurf::viz::scene_test
