#include "viz/map_axes.h"

#include <charconv>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace clsurf::viz {
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
    double value = 0;
    const auto [end, error] = std::from_chars(text.text.data(), text.text.data() + text.text.size(), value);
    return error == std::errc() && end == text.text.data() + text.text.size()
               ? value
               : std::numeric_limits<double>::quiet_NaN();
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
}  // namespace clsurf::viz
