#include "viz/defect_marks.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/stitched_path.h"
#include "viz/scene.h"

namespace clsurf::viz::defect_marks_test {
namespace {

const Rgb white{255, 255, 255};

/// 21 passes of 10 mm along X, from above.
class Part {
public:
    Part() : surface_(test::surface_of(test::zigzag(21, 10, 0.5, 0.1), 0.5)) {
        field_.values = Column<float>(static_cast<std::size_t>(surface_.positions.size()), 1.0F);
    }
    [[nodiscard]] Sheet sheet(const DefectMap& defects, const Zoom& zoom = {}, const std::string& view = "top",
                              Look look = {}) const {
        look.zoom = zoom;
        look.view = parse_view(view);
        look.names = true;
        MapPanel panel;
        panel.surface = &surface_;
        panel.field = &field_;
        panel.defects = &defects;
        return map_sheet({panel}, placed_map({panel}, look), {}, {}, look);
    }
    [[nodiscard]] Vec2 pixel(const Sheet& sheet, PointIndex point) const {
        const MeshPanel& panel = sheet.panels[0];
        return Vec2(panel.rect.x, panel.rect.y) + panel.camera.pixel(surface_.positions.absolute(point));
    }

private:
    ClSurface surface_;
    Field field_;
};

DefectMark mark_of(const std::string& number, std::vector<PointRange> sections) {
    DefectMark mark;
    mark.sections = std::move(sections);
    mark.number = number;
    mark.label = "−40 % speed";
    mark.lines = "line " + number;
    return mark;
}

DefectMap map_of(std::vector<DefectMark> marks) {
    DefectMap map;
    map.kinds = {{"speed", {200, 70, 0}, StrokeStyle::solid}};
    map.marks = std::move(marks);
    return map;
}

TEST(DefectMarks, TheCasingOfALeaderIsBelowTheMarks) {
    const Sheet sheet = Part().sheet(map_of({mark_of("1", {{1020, 1060}})}));
    bool cased = false;
    for (const FlatLine& line : sheet.lines) {
        if (line.rgb != white || line.level >= Level::halo) continue;
        cased = true;
        EXPECT_LT(line.level, Level::mark) << "it would erase a mark that the leader runs along";
    }
    EXPECT_TRUE(cased);
}

/// The middle of the white dot at the beginning of a leader.
Vec2 anchor_in(const Sheet& sheet) {
    Vec2 sum = Vec2::Zero();
    int count = 0;
    for (const FlatLine& line : sheet.lines) {
        if (line.level != Level::dot_fill) continue;
        sum += 0.5 * (line.points.front() + line.points.back());
        ++count;
    }
    return sum / std::max(1, count);
}

bool has_text(const Sheet& sheet, const std::string& words) {
    return std::any_of(sheet.texts.begin(), sheet.texts.end(),
                       [&](const FlatText& text) { return text.text == words; });
}

TEST(DefectMarks, ALeaderBeginsWhereTheWordsAreOf) {
    const Part part;
    // The strongest point is in the shorter section.
    DefectMark mark = mark_of("1", {{1020, 1030}, {1220, 1290}});
    mark.point = 1022;
    const Sheet section = part.sheet(map_of({mark}));
    EXPECT_LT((anchor_in(section) - part.pixel(section, 1025)).norm(), 2) << "in the middle of its section";
    mark.region = true;
    const Sheet region = part.sheet(map_of({mark}));
    EXPECT_LT((anchor_in(region) - part.pixel(region, 1022)).norm(), 2) << "at the point itself";
}

TEST(DefectMarks, AStrongerMarkHidesNoAnchor) {
    const Part part;
    // The second one has its strongest section below the first one, except for its end.
    DefectMark weaker = mark_of("2", {{1070, 1100}, {1280, 1310}});
    weaker.point = 1080;
    DefectMap map = map_of({mark_of("1", {{1060, 1092}}), weaker});
    const auto is_at = [&](const Sheet& sheet, PointIndex point) {
        return std::any_of(sheet.lines.begin(), sheet.lines.end(), [&](const FlatLine& line) {
            return line.level == Level::dot_fill && (line.points.front() - part.pixel(sheet, point)).norm() < 12;
        });
    };
    Sheet sheet = part.sheet(map);
    EXPECT_FALSE(is_at(sheet, 1085));
    EXPECT_TRUE(is_at(sheet, 1097));
    map.marks[0].sections = {{1060, 1102}};
    sheet = part.sheet(map);
    EXPECT_FALSE(is_at(sheet, 1085));
    EXPECT_TRUE(is_at(sheet, 1295)) << "no place of the section is free, another section is";
}

TEST(DefectMarks, SayWhereTheirStrongestSectionIsNotInThePicture) {
    const Part part;
    DefectMark mark = mark_of("1", {{10, 30}, {2020, 2060}});
    mark.point = 20;
    EXPECT_TRUE(has_text(part.sheet(map_of({mark})), "line 1"));
    const Sheet upper = part.sheet(map_of({mark}), {0, 0, 1, 0.5});
    EXPECT_FALSE(has_text(upper, "line 1"));
    EXPECT_TRUE(has_text(upper, "strongest outside the picture"));
}

TEST(DefectMarks, TheKeyHasWhatIsInThePicture) {
    const Part part;
    const Sheet sheet = part.sheet(map_of({mark_of("1", {{1020, 1060}})}));
    EXPECT_TRUE(has_text(sheet, "speed"));
    EXPECT_FALSE(has_text(sheet, "hidden")) << "nothing hides a flat part";
    EXPECT_FALSE(has_text(sheet, "speed, systematic"));
    DefectMark region = mark_of("1", {{1020, 1060}});
    region.region = true;
    EXPECT_TRUE(has_text(Part().sheet(map_of({region})), "speed, systematic"));
}

TEST(DefectMarks, ARegionIsNamedHoweverWeakItIs) {
    std::vector<DefectMark> marks;
    for (int k = 0; k < 16; ++k) marks.push_back(mark_of(std::to_string(k + 1), {{105 * k + 20, 105 * k + 40}}));
    marks[14].region = true;
    const Sheet sheet = Part().sheet(map_of(std::move(marks)));
    EXPECT_TRUE(has_text(sheet, "line 11"));
    EXPECT_FALSE(has_text(sheet, "line 12")) << "the twelfth name is that of the region";
    EXPECT_TRUE(has_text(sheet, "line 15"));
    EXPECT_TRUE(has_text(sheet, "and 4 more"));
}

TEST(DefectMarks, NumbersOfANarrowPartStandAboveItOrAreCounted) {
    std::vector<DefectMark> marks;
    for (int k = 0; k < 10; ++k) marks.push_back(mark_of(std::to_string(k + 1), {{105 * k + 20, 105 * k + 40}}));
    Look tall;
    tall.width = 400;
    tall.height = 800;
    const DefectMap few = map_of({marks[0], marks[1], marks[2]});
    const Sheet sheet = Part().sheet(few, {}, "front", tall);
    const MeshPanel& panel = sheet.panels[0];
    for (const std::string number : {"1", "2", "3"}) {
        const auto text = std::find_if(sheet.texts.begin(), sheet.texts.end(),
                                       [&](const FlatText& each) { return each.text == number; });
        ASSERT_NE(text, sheet.texts.end());
        EXPECT_GT(text->y, panel.rect.y + panel.rect.height) << "it would hide the part";
    }
    // Long numbers, all at the same place.
    for (DefectMark& mark : marks) {
        mark.sections = {{20, 40}};
        mark.number += "00000000";
    }
    tall.height = 1600;
    const Sheet full = Part().sheet(map_of(std::move(marks)), {}, "front", tall);
    const bool counted = std::any_of(full.texts.begin(), full.texts.end(), [](const FlatText& text) {
        return text.text.find("do not fit") != std::string::npos;
    });
    EXPECT_TRUE(counted);
}

/// All points of the lines that draw a mark.
std::vector<Vec2> drawn_marks(const Sheet& sheet) {
    std::vector<Vec2> all;
    for (const FlatLine& line : sheet.lines) {
        if (line.level != Level::mark || !line.clip) continue;
        for (const Vec2& point : outline_of(line)) all.push_back(point);
    }
    return all;
}

double height_of(const std::vector<Vec2>& points) {
    const auto [low, high] =
        std::minmax_element(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); });
    return high->y() - low->y();
}

TEST(DefectMarks, AMarkIsAsWideAsItsStripOfThePartIsSeen) {
    const Part part;
    const DefectMap middle = map_of({mark_of("1", {{1070, 1100}})});
    const auto step_over = [&](const Sheet& sheet) { return 0.5 / sheet.panels[0].camera.mm_per_pixel; };
    const Sheet above = part.sheet(middle);
    EXPECT_NEAR(height_of(drawn_marks(above)), step_over(above), 1);
    const Sheet border = part.sheet(map_of({mark_of("1", {{20, 60}})}));
    EXPECT_NEAR(height_of(drawn_marks(border)), 0.5 * step_over(border), 1) << "the surface ends at the outermost pass";
    // From the side the flat part is a line, and a mark on it has its least width.
    const Sheet flat = part.sheet(middle, {}, "front");
    EXPECT_LT(height_of(drawn_marks(flat)), 0.3 * step_over(flat));
    EXPECT_GT(height_of(drawn_marks(flat)), 1);
}

}  // namespace
}  // namespace clsurf::viz::defect_marks_test
