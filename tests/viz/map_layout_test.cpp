// Wide and tall pictures: the part fills the shorter side, and texts and legend are in the remaining area.
#include "viz/map_layout.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "support/stitched_path.h"
#include "viz/field_colours.h"
#include "viz/scene.h"

namespace clsurf::viz::map_layout_test {
namespace {

/// A flat part, 10 mm wide and `deep` mm deep, from above.
class FlatPart {
public:
    explicit FlatPart(int passes) : surface_(test::surface_of(test::zigzag(passes, 10, 0.5, 0.1), 0.5)) {
        field_.info.name = "speed";
        field_.info.label = "Path speed";
        field_.info.unit = unit::mm_min;
        field_.values = Column<float>(static_cast<std::size_t>(surface_.positions.size()), 1.0F);
    }
    [[nodiscard]] Sheet sheet(int width, int height, const DefectMap* defects = nullptr) const {
        Look look;
        look.width = width;
        look.height = height;
        look.view = parse_view("top");
        look.names = defects != nullptr;
        MapPanel panel;
        panel.surface = &surface_;
        panel.field = &field_;
        panel.defects = defects;
        MapTexts texts;
        texts.title = "Path speed, commanded surface";
        texts.subtitle = "part.nc · run.biip";
        return map_sheet({panel}, placed_map({panel}, look), scale_of(field_.info, 0, 1), texts, look);
    }
    /// Size of the part in the picture [px].
    [[nodiscard]] Vec2 size_in(const Sheet& sheet) const {
        Vec2 low(1e9, 1e9);
        Vec2 high = -low;
        for (PointIndex i = 0; i < surface_.positions.size(); ++i) {
            const Vec2 at = sheet.panels[0].camera.pixel(surface_.positions.absolute(i));
            low = low.cwiseMin(at);
            high = high.cwiseMax(at);
        }
        return high - low;
    }

private:
    ClSurface surface_;
    Field field_;
};

const FlatText& text_of(const Sheet& sheet, const std::string& part) {
    return *std::find_if(sheet.texts.begin(), sheet.texts.end(),
                         [&](const FlatText& text) { return text.text.find(part) != std::string::npos; });
}

/// The first line of the name of the colour scale.
const FlatText& legend_of(const Sheet& sheet) {
    return *std::find_if(sheet.texts.begin(), sheet.texts.end(), [](const FlatText& text) {
        return text.text.starts_with("Path speed") && text.text.find(',') == std::string::npos;
    });
}

double right_of(const Rect& rect) { return rect.x + rect.width; }

TEST(MapLayout, AWidePictureGivesItsHeightToThePart) {
    const FlatPart part(21);  // 10 mm × 10 mm
    const Sheet sheet = part.sheet(2560, 720);
    EXPECT_GT(part.size_in(sheet).y(), 0.8 * 720);
    const Rect& panel = sheet.panels[0].rect;
    EXPECT_LT(text_of(sheet, "Path speed,").x, panel.x) << "the title is a column at the left";
    EXPECT_LT(text_of(sheet, "run.biip").y, text_of(sheet, "part.nc").y) << "a line for each part of the subtitle";
    const FlatText& legend = legend_of(sheet);
    EXPECT_GT(legend.x, right_of(panel));
    EXPECT_LT(legend.x, right_of(panel) + 0.1 * 2560) << "the colours are beside the part";
}

TEST(MapLayout, ATallPictureGivesItsWidthToThePart) {
    const FlatPart part(21);
    const Sheet sheet = part.sheet(800, 2400);
    EXPECT_GT(part.size_in(sheet).x(), 0.8 * 800);
    EXPECT_LT(legend_of(sheet).y, sheet.panels[0].rect.y) << "the colours are below the part";
}

TEST(MapLayout, AUsualPictureStaysAsItIs) {
    for (const auto& [width, height] : {std::pair(1600, 1200), std::pair(1920, 1080), std::pair(640, 480)}) {
        Look look;
        look.width = width;
        look.height = height;
        const Sheet sheet = FlatPart(21).sheet(width, height);
        EXPECT_GT(legend_of(sheet).x, width - MapLayout(look).legend_width) << width;
    }
}

TEST(MapLayout, AFlatPartInAWidePictureKeepsTheTitleAbove) {
    const FlatPart part(3);  // 10 mm × 1 mm: the column would cost it width
    const Sheet sheet = part.sheet(2560, 720);
    EXPECT_GT(text_of(sheet, "Path speed,").y, sheet.panels[0].rect.y + sheet.panels[0].rect.height);
}

TEST(MapLayout, TheTableOfATallPictureHasEveryDefect) {
    DefectMap map;
    map.kinds = {{"speed", {200, 70, 0}, StrokeStyle::solid}};
    for (int k = 1; k <= 20; ++k) {
        DefectMark mark;
        mark.sections = {{100 * k, 100 * k + 20}};
        mark.number = std::to_string(k);
        mark.label = "−40 % speed";
        mark.lines = "line " + std::to_string(1000 + k);
        mark.place = "X " + std::to_string(k);
        map.marks.push_back(mark);
    }
    const FlatPart part(21);
    const Sheet sheet = part.sheet(800, 2400, &map);
    const Rect& panel = sheet.panels[0].rect;
    for (int k = 1; k <= 20; ++k) {
        const std::string line = "line " + std::to_string(1000 + k);
        const auto found =
            std::find_if(sheet.texts.begin(), sheet.texts.end(), [&](const FlatText& t) { return t.text == line; });
        ASSERT_NE(found, sheet.texts.end()) << line;
        EXPECT_LT(found->y, panel.y) << "below the part";
        const auto number = std::find_if(sheet.texts.begin(), sheet.texts.end(), [&](const FlatText& t) {
            return t.text == std::to_string(k) && t.y > panel.y && t.y < panel.y + panel.height;
        });
        EXPECT_NE(number, sheet.texts.end()) << k << " stands on the part";
    }
}

}  // namespace
}  // namespace clsurf::viz::map_layout_test
