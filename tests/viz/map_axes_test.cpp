#include "viz/map_axes.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace clsurf::viz::map_axes_test {
namespace {

MeshPanel panel_of(const Look& look, const Box3& part) {
    MeshPanel panel;
    panel.rect = {100, 60, 600, 400};
    panel.camera = camera_for(look.view, part, 600, 400, look.zoom);
    return panel;
}

const Box3 part(Vec3(-10, -4, 2), Vec3(30, 16, 12));

/// The number of a label.
double number_of(const FlatText& text) {
    constexpr std::string_view minus = "−";
    const bool is_negative = text.text.starts_with(minus);
    const std::string digits = text.text.substr(is_negative ? minus.size() : 0);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size()) return std::numeric_limits<double>::quiet_NaN();
    return is_negative ? -value : value;
}

TEST(MapAxes, ATickStandsWhereItsNumberSays) {
    Look look;
    look.view = parse_view("top");
    const MeshPanel panel = panel_of(look, part);
    Sheet sheet;
    add_scales(sheet, panel, part, "G54", look, MapLayout(look));
    int across = 0;
    int up = 0;
    for (const FlatText& text : sheet.texts) {
        const double value = number_of(text);
        if (!(value == value)) continue;
        if (text.align == Align::centre) {
            EXPECT_NEAR(text.x, 100 + panel.camera.pixel(Vec3(value, 0, 0)).x(), 0.01) << text.text;
            ++across;
        } else {
            EXPECT_NEAR(text.y, 60 + panel.camera.pixel(Vec3(0, value, 0)).y(), 0.01) << text.text;
            ++up;
        }
    }
    EXPECT_GE(across, 3);
    EXPECT_GE(up, 2);
}

TEST(MapAxes, NamesItsAxesAndTheirCoordinates) {
    Look look;
    look.view = parse_view("front");
    Sheet sheet;
    add_scales(sheet, panel_of(look, part), part, "G55", look, MapLayout(look));
    std::vector<std::string> names;
    for (const FlatText& text : sheet.texts) {
        if (text.bold) names.push_back(text.text);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"X [mm, G55]", "Z [mm]"}));
}

TEST(MapAxes, ABoxHasThreeScales) {
    Look look;
    look.view = parse_view("iso");
    EXPECT_TRUE(has_box(look));
    EXPECT_FALSE(has_frame(look));
    Sheet sheet;
    add_scales(sheet, panel_of(look, part), part, "", look, MapLayout(look));
    std::string names;
    for (const FlatText& text : sheet.texts) {
        if (text.bold) names += text.text + ";";
    }
    EXPECT_EQ(names, "X [mm];Y [mm];Z [mm];");
}

TEST(MapAxes, AFlatBoxHasTheScalesOfAnyBoxAndTellsItsHeight) {
    const Box3 flat(Vec3(-10, -4, 2), Vec3(30, 16, 2));
    Look look;
    look.view = parse_view("iso");
    Sheet sheet;
    add_scales(sheet, panel_of(look, flat), flat, "", look, MapLayout(look));
    std::string names;
    for (const FlatText& text : sheet.texts) {
        const bool height = text.text == "Z 2.000 mm";
        if (text.bold || height) names += text.text + ";";
        // No edge crosses it: it is in the lower left corner.
        if (height) { EXPECT_LT(text.y, 60 + 0.1 * 400); }
    }
    EXPECT_EQ(names, "X [mm];Y [mm];Z 2.000 mm;");
    Sheet thin;
    const Box3 low(Vec3(-10, -4, 2), Vec3(30, 16, 2.1));
    add_scales(thin, panel_of(look, low), low, "", look, MapLayout(look));
    EXPECT_EQ(thin.texts.back().text, "Z 2.00 to 2.10 mm");
    EXPECT_LT(thin.texts.back().y, 60 + 0.1 * 400);
    EXPECT_EQ(thin.lines.size(), sheet.lines.size());
}

TEST(MapAxes, AScaleTooShortForNumbersTellsItsRange) {
    Look look;
    look.view = parse_view("iso");
    const Box3 flat(Vec3(-10, -4, -0.3), Vec3(30, 16, 0.1));
    Sheet sheet;
    add_scales(sheet, panel_of(look, flat), flat, "", look, MapLayout(look));
    bool told = false;
    for (const FlatText& text : sheet.texts) told = told || text.text == "Z −0.30 to 0.10 mm";
    EXPECT_TRUE(told);
}

TEST(MapAxes, ARangeIsThatOfThePartAndNotOfItsFrame) {
    // 1 px is 0.4 mm: the frame is several millimetres from the part.
    const Box3 strip(Vec3(0, 0, -2), Vec3(220, 5.75, 5));
    for (const std::string view : {"top", "front"}) {
        Look look;
        look.view = parse_view(view);
        Sheet sheet;
        add_scales(sheet, panel_of(look, strip), strip, "", look, MapLayout(look));
        const std::string wanted = view == "top" ? "Y 0.0 to 5.8 mm" : "Z −2.0 to 5.0 mm";
        EXPECT_TRUE(std::any_of(sheet.texts.begin(), sheet.texts.end(), [&](const FlatText& text) {
            return text.text == wanted;
        })) << wanted;
    }
}

TEST(MapAxes, NumbersOfTwoScalesDoNotRunIntoEachOther) {
    Look look;
    look.view = parse_view("iso");
    // X ends at 20 in the corner where Y begins at −10.
    const Box3 dome(Vec3(-20, -10, -3), Vec3(20, 10, 0));
    Sheet sheet;
    add_scales(sheet, panel_of(look, dome), dome, "", look, MapLayout(look));
    std::vector<FlatText> numbers;
    for (const FlatText& text : sheet.texts) {
        if (number_of(text) == number_of(text)) numbers.push_back(text);
    }
    ASSERT_GT(numbers.size(), 6u);
    for (std::size_t a = 0; a < numbers.size(); ++a) {
        for (std::size_t b = a + 1; b < numbers.size(); ++b) {
            const bool apart_in_y = std::abs(numbers[a].y - numbers[b].y) >= numbers[a].size;
            const auto left = [](const FlatText& t) {
                return t.x - (t.align == Align::centre ? 0.5 : t.align == Align::right ? 1.0 : 0.0) * text_width(t);
            };
            const double gap = std::max(left(numbers[b]) - left(numbers[a]) - text_width(numbers[a]),
                                        left(numbers[a]) - left(numbers[b]) - text_width(numbers[b]));
            EXPECT_TRUE(apart_in_y || gap > 0.3 * numbers[a].size) << numbers[a].text << numbers[b].text;
        }
    }
}

TEST(MapAxes, APartOfAPictureHasNoBox) {
    Look look;
    look.zoom = {0.2, 0.2, 0.6, 0.6};
    EXPECT_FALSE(has_box(look));
    look.view = parse_view("left");
    EXPECT_TRUE(has_frame(look)) << "what is shown of the axes still fits a frame";
    look.legend = false;
    EXPECT_FALSE(has_frame(look)) << "only the map";
}

}  // namespace
}  // namespace clsurf::viz::map_axes_test
