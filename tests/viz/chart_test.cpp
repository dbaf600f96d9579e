#include "viz/chart.h"
#include "viz/chart_frame.h"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "viz/drawing.h"
#include "viz/trend_chart.h"

namespace clsurf::viz::chart_test {
namespace {

TEST(ThinCurve, KeepsEveryExtremeOfEveryColumn) {
    std::mt19937 random(5);
    std::vector<double> x(100'000);
    std::vector<double> y(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = static_cast<double>(i);
        y[i] = static_cast<double>(random() % 1000);
    }
    y[12'345] = 1e6;
    y[54'321] = -1e6;
    const std::vector<Vec2> thin = thin_curve(x, y, 0, 99'999, 500);
    EXPECT_LE(thin.size(), 4u * 501);
    EXPECT_TRUE(std::any_of(thin.begin(), thin.end(), [](const Vec2& p) { return p == Vec2(12'345, 1e6); }));
    EXPECT_TRUE(std::any_of(thin.begin(), thin.end(), [](const Vec2& p) { return p == Vec2(54'321, -1e6); }));
    for (std::size_t i = 1; i < thin.size(); ++i) EXPECT_LT(thin[i - 1].x(), thin[i].x());
}

TEST(ThinCurve, KeepsTheExtremesOnBothSidesOfAGap) {
    constexpr double gap = std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> x{0, 1, 2, 3, 4, 5, 6, 100};  // all but the last one in the first of ten columns
    const auto has = [](const std::vector<Vec2>& points, const Vec2& p) {
        return std::find(points.begin(), points.end(), p) != points.end();
    };
    std::vector<Vec2> thin = thin_curve(x, std::vector<double>{1, 9, -7, gap, 2, 3, 1, 0}, 0, 100, 10);
    EXPECT_TRUE(has(thin, Vec2(1, 9)));
    EXPECT_TRUE(has(thin, Vec2(2, -7)));
    thin = thin_curve(x, std::vector<double>{gap, gap, 2, -7, 9, 1, 1, 0}, 0, 100, 10);
    EXPECT_TRUE(has(thin, Vec2(3, -7)));
    EXPECT_TRUE(has(thin, Vec2(4, 9)));
}

/// The numbers to the left of a plot whose frame begins at x [px].
std::ptrdiff_t y_numbers(const std::vector<FlatText>& texts, double x) {
    return std::ranges::count_if(texts, [&](const FlatText& t) { return t.align == Align::right && t.x < x; });
}

TEST(Chart, ATallPlotHasAYAxis) {
    // 1600 by 900 with text of 20.45 px: the frame is 688 px high, room for eleven ticks.
    ChartLook look;
    look.keep_drawing = true;
    const Image image = draw_chart(std::vector<double>{0, 1, 2}, {{"speed", {500, 1000, 1500}}}, {}, look);
    EXPECT_GE(y_numbers(image.drawing->texts, 6.5 * 900 / 44), 2);
}

TEST(Trend, ATallPlotHasAYAxis) {
    ChartLook look;
    look.width = 800;
    look.height = 1600;
    look.keep_drawing = true;
    TrendPicture picture;
    picture.groups = {""};
    picture.symbols = {{3, "1", "2026-11-01"}, {5, "2", "2026-11-02"}};
    EXPECT_GE(y_numbers(draw_trend(picture, look).drawing->texts, 6.5 * 480 / 40), 2);
}

TEST(Chart, BreaksAFootnoteBeforeTheEdge) {
    ChartLook look;
    look.width = 640;
    look.height = 480;
    for (int k = 0; k < 40; ++k) look.footnote += "window of 21 ms; ";
    const std::vector<double> x{0, 1, 2};
    const Image image = draw_chart(x, {{"speed", {1, 2, 3}}}, {}, look);
    int ink = 0;
    for (int y = 0; y < image.height; ++y) ink += image.pixel(image.width - 2, y)[0] < 200 ? 1 : 0;
    EXPECT_EQ(ink, 0);
}

}  // namespace
}  // namespace clsurf::viz::chart_test
