// Drawing without a display: the context is a software one, and a pixel has its colour.
#include "viz/canvas.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "core/error.h"
#include "viz/drawing.h"
#include "viz/gl_context.h"
#include "viz/vector_picture.h"

namespace clsurf::viz::drawing_test {
namespace {

Sheet red_square() {
    Sheet sheet;
    sheet.width = 80;
    sheet.height = 60;
    MeshPanel panel;
    panel.rect = {0, 0, 80, 60};
    panel.camera = camera_for(parse_view("top"), Box3(Vec3(0, 0, 0), Vec3(10, 10, 0)), 80, 60, {});
    for (const float v : {0.F, 0.F, 0.F, 10.F, 0.F, 0.F, 10.F, 10.F, 0.F, 0.F, 10.F, 0.F})
        panel.geometry.xyz.push_back(v);
    for (int k = 0; k < 4; ++k) {
        for (const std::uint8_t c : {200, 30, 40}) panel.geometry.rgb.push_back(c);
    }
    for (const std::uint32_t v : {0u, 1u, 2u, 0u, 2u, 3u}) panel.geometry.triangles.push_back(v);
    sheet.panels.push_back(std::move(panel));
    return sheet;
}

TEST(Drawing, UsesASoftwareRendererWithoutADisplay) {
    ::unsetenv("DISPLAY");
    const auto context = make_gl_context("osmesa", 64, 64);
    const std::string name = context->renderer();
    EXPECT_TRUE(name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos) << name;
}

TEST(Drawing, GivesAPixelItsColour) {
    ::unsetenv("DISPLAY");
    const Image image = draw(red_square(), "osmesa", 2);
    const std::uint8_t* middle = image.pixel(40, 30);
    EXPECT_EQ(middle[0], 200);
    EXPECT_EQ(middle[1], 30);
    EXPECT_EQ(middle[2], 40);
    EXPECT_EQ(image.pixel(1, 1)[0], 255);
}

/// Two wide lines across the picture, clipped to the middle 40 by 10 pixels.
Sheet clipped_lines() {
    Sheet sheet;
    sheet.width = 80;
    sheet.height = 60;
    for (const double y : {26.0, 34.0}) {
        FlatLine line{{{5, y}, {75, y}}, 16, {10, 20, 200}};
        line.clip = Rect{20, 25, 40, 10};
        sheet.lines.push_back(line);
    }
    return sheet;
}

TEST(Drawing, LinesEndAtTheirClip) {
    ::unsetenv("DISPLAY");
    const Image image = draw(clipped_lines(), "osmesa", 2);
    for (int y = 0; y < 60; ++y) {
        for (int x = 0; x < 80; ++x) {
            const bool inside = x >= 20 && x < 60 && y >= 25 && y < 35;  // symmetric from above and from below
            EXPECT_EQ(image.pixel(x, y)[0], inside ? 10 : 255) << x << ", " << y;
        }
    }
    Sheet whole = clipped_lines();
    for (FlatLine& line : whole.lines) line.clip.reset();
    EXPECT_EQ(draw(whole, "osmesa", 2).pixel(10, 30)[0], 10);
}

TEST(Drawing, ClipsAreWrittenOnceAndMoveWithTheirPicture) {
    Drawing drawing;
    drawing.width = 200;
    drawing.height = 60;
    Drawing part;
    part.lines = clipped_lines().lines;
    add(drawing, part, 100, 0);
    const std::string svg = svg_text(drawing, "clips");
    EXPECT_NE(svg.find("<clipPath id=\"clip1\"><rect x=\"120.00\" y=\"25.00\" width=\"40.00\" height=\"10.00\"/>"),
              std::string::npos)
        << svg;
    EXPECT_EQ(svg.find("clip2"), std::string::npos) << svg;
}

TEST(Drawing, KeepsTheSpacesOfTexts) {
    Drawing drawing;
    drawing.width = 200;
    drawing.height = 60;
    drawing.texts.push_back({});
    drawing.texts.back().text = "6  ±75.4 µm";
    drawing.text_widths.push_back(70);
    const std::string svg = svg_text(drawing, "spaces");
    EXPECT_NE(svg.find(">6  ±75.4 µm</text>"), std::string::npos) << svg;
    EXPECT_NE(svg.find("<text xml:space=\"preserve\""), std::string::npos) << svg;  // of <svg> it is not inherited
}

TEST(Drawing, GivesWhatLiesBetweenVerticesAColourOfTheRamp) {
    Sheet sheet = red_square();
    MeshPanel& panel = sheet.panels[0];
    panel.ramp = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}};
    panel.stepped = true;
    for (const float at : {0.F, 1.F, 1.F, 0.F}) panel.along.push_back(at);  // from left to right
    for (std::uint8_t& c : panel.geometry.rgb) c = 255;
    const Image image = draw(sheet, "osmesa", 2);
    // A mixture of the ends would be purple.
    EXPECT_EQ(image.pixel(40, 30)[1], 255);
    EXPECT_EQ(image.pixel(40, 30)[0], 0);
    EXPECT_EQ(image.pixel(20, 30)[0], 255);
    EXPECT_EQ(image.pixel(60, 30)[2], 255);
}

TEST(Drawing, HatchesTrianglesWithoutAValue) {
    Sheet sheet = red_square();
    MeshPanel& panel = sheet.panels[0];
    panel.ramp = {{255, 0, 0}, {0, 0, 255}};
    panel.along = Column<float>(4, 0.F);
    panel.bare_colour = {150, 150, 150};
    panel.bare_ground = {240, 255, 240};
    for (std::uint8_t& c : panel.geometry.rgb) c = 255;
    std::swap(panel.bare_triangles, panel.geometry.triangles);
    const Image image = draw(sheet, "osmesa", 2);
    int lines = 0;
    int ground = 0;
    for (int x = 30; x < 46; ++x) {
        EXPECT_EQ(image.pixel(x, 30)[0], image.pixel(x, 30)[2]) << "neither red nor blue";
        lines += image.pixel(x, 30)[0] < 225 ? 1 : 0;
        ground += image.pixel(x, 30)[0] == 240 ? 1 : 0;
    }
    // One pixel of eight is a line, and its neighbours may share it.
    EXPECT_GE(lines, 1);
    EXPECT_LE(lines, 4);
    EXPECT_GE(ground, 8);
}

TEST(Drawing, DrawsPaleVerticesInALighterTone) {
    Sheet sheet = red_square();
    MeshPanel& panel = sheet.panels[0];
    panel.ramp = {{0, 0, 0}, {200, 200, 200}};
    panel.along = Column<float>(4, 0.F);
    panel.pale = Column<float>(4, 1.F);
    for (std::uint8_t& c : panel.geometry.rgb) c = 255;
    // 60 % of the way to the lightest colour of the ramp.
    EXPECT_EQ(draw(sheet, "osmesa", 2).pixel(40, 30)[0], 120);
}

TEST(Drawing, GivesTheSamePixelsEveryTime) {
    const Image a = draw(red_square(), "osmesa", 2);
    const Image b = draw(red_square(), "osmesa", 2);
    EXPECT_TRUE(std::equal(a.rgb.begin(), a.rgb.end(), b.rgb.begin()));
}

TEST(Drawing, PutsTextsAboveQuads) {
    Sheet sheet = red_square();
    sheet.quads.push_back({{0, 0, 80, 60}, {255, 255, 255}});
    sheet.texts.push_back({40, 30, "M", 40, Align::centre, true, {0, 0, 0}});
    const Image image = draw(sheet, "osmesa", 2);
    const bool dark = std::any_of(image.rgb.begin(), image.rgb.end(), [](std::uint8_t v) { return v < 60; });
    EXPECT_TRUE(dark);
}

TEST(Drawing, PutsLinesAboveThoseUnderThem) {
    Sheet sheet = red_square();
    sheet.lines.push_back({{{10, 30}, {70, 30}}, 4, {0, 0, 0}, Level::line});
    sheet.lines.push_back({{{10, 30}, {70, 30}}, 12, {255, 255, 255}, Level::area});
    const Image image = draw(sheet, "osmesa", 2);
    EXPECT_EQ(image.pixel(40, 30)[0], 0);
    EXPECT_EQ(image.pixel(40, 34)[0], 255);
    EXPECT_EQ(image.pixel(40, 34)[1], 255);
}

TEST(Drawing, RefusesAnUnknownContext) { EXPECT_THROW((void)make_gl_context("glx", 8, 8), UsageError); }

}  // namespace
}  // namespace clsurf::viz::drawing_test
