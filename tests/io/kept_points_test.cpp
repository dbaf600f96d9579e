// Which points of a log a page keeps: no significant point is left out.

#include "io/page/kept_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "program/program.h"
#include "surface/cl_surface.h"

namespace clsurf::kept_points_test {
namespace {

constexpr PointIndex points = 20'000;
constexpr PointIndex per_pass = 1000;

/// A raster of straight passes, points 0.01 mm apart, passes 0.3 mm; no links.
ClSurface raster() {
    ClSurface surface;
    Positions& p = surface.positions;
    for (PointIndex i = 0; i < points; ++i) {
        p.x.push_back(0.01F * static_cast<float>(i % per_pass));
        p.y.push_back(0.3F * static_cast<float>(i / per_pass));
        p.z.push_back(0);
    }
    for (PointIndex first = 0; first < points; first += per_pass)
        surface.passes.push_back({first, first + per_pass - 1, PassKind::cut});
    surface.step_over = 0.3;
    return surface;
}

/// Lines of 37 points each.
struct Lines {
    Column<std::uint32_t> numbers;
    Program program;
    LineMap map;

    static Program empty_program() {
        Program program;
        program.files.emplace_back("part.nc", "", nullptr);
        return program;
    }
    static Column<std::uint32_t> make() {
        Column<std::uint32_t> lines;
        for (PointIndex i = 0; i < points; ++i) lines.push_back(static_cast<std::uint32_t>(1 + i / 37));
        return lines;
    }
    Lines() : numbers(make()), program(empty_program()), map(view(), program, nullptr) {}

private:
    [[nodiscard]] ChannelView view() const {
        ChannelView channel;
        channel.first = reinterpret_cast<const std::byte*>(numbers.data());
        channel.stride = sizeof(std::uint32_t);
        channel.count = points;
        channel.type = ScalarType::u32;
        return channel;
    }
};

Field noise() {
    Field field;
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    for (PointIndex i = 0; i < points; ++i) field.values.push_back(normal(random));
    return field;
}

bool keeps(const KeptPoints& kept, PointIndex i) {
    return std::binary_search(kept.points.begin(), kept.points.end(), i);
}

TEST(KeptPoints, AllStayWhereTheyFit) {
    const Lines lines;
    const std::vector<Field> fields{noise()};
    const KeptPoints kept = keep_points(raster(), lines.map, fields, {}, points);
    EXPECT_FALSE(kept.reduced());
    EXPECT_EQ(static_cast<PointIndex>(kept.points.size()), points);
}

TEST(KeptPoints, ExtremesOfEveryWindowEndsOfPassesAndStartsOfLinesStay) {
    const ClSurface surface = raster();
    const Lines lines;
    const std::vector<Field> fields{noise(), noise()};
    const KeptPoints kept = keep_points(surface, lines.map, fields, {}, 4000);
    ASSERT_TRUE(kept.reduced());
    EXPECT_TRUE(kept.line_starts);
    EXPECT_LE(kept.points.size(), 4000U);
    EXPECT_GT(kept.points.size(), 2500U);  // and room is used
    for (const Pass& pass : surface.passes) {
        EXPECT_TRUE(keeps(kept, pass.first) && keeps(kept, pass.last));
        for (PointIndex first = pass.first; first <= pass.last; first += kept.window) {
            const PointIndex last = std::min(pass.last, first + kept.window - 1);
            for (const Field& field : fields) {
                const auto [low, high] =
                    std::minmax_element(field.values.begin() + first, field.values.begin() + last + 1);
                EXPECT_TRUE(keeps(kept, low - field.values.begin()));
                EXPECT_TRUE(keeps(kept, high - field.values.begin()));
            }
        }
    }
    for (PointIndex i = 0; i < points; i += 37) EXPECT_TRUE(keeps(kept, i)) << i;
}

TEST(KeptPoints, ADefectStaysWhole) {
    Defect defect;
    defect.point = 5250;
    defect.sections.push_back({6, {5200, 5300}, 1, 1});
    defect.neighbours.push_back({5, {4700, 4800}, 1, 1});
    const Lines lines;
    const std::vector<Field> fields{noise()};
    const KeptPoints kept = keep_points(raster(), lines.map, fields, {&defect, 1}, 2500);
    for (PointIndex i = 5200; i <= 5300; ++i) EXPECT_TRUE(keeps(kept, i));
    for (PointIndex i = 4700; i <= 4800; ++i) EXPECT_TRUE(keeps(kept, i));
}

TEST(KeptPoints, DefectsTooLargeForAQuarterOfTheRoomAreReducedLikeAllElse) {
    // 12 passes of 900 points, and then one of 100 points.
    Defect large;
    large.point = 450;
    for (PointIndex pass = 0; pass < 12; ++pass)
        large.sections.push_back({pass, {pass * per_pass + 50, pass * per_pass + 949}, 1, 1});
    Defect small;
    small.point = 15'050;
    small.sections.push_back({15, {15'000, 15'099}, 1, 1});
    const std::vector<Defect> defects{large, small};
    const Lines lines;
    const std::vector<Field> fields{noise()};
    const KeptPoints kept = keep_points(raster(), lines.map, fields, defects, 4000);
    EXPECT_EQ(kept.defects, 2U);
    EXPECT_EQ(kept.whole_defects, 1U);
    EXPECT_LE(kept.points.size(), 4000U);
    for (PointIndex i = 15'000; i <= 15'099; ++i) EXPECT_TRUE(keeps(kept, i));
    for (const DefectSection& section : large.sections)
        EXPECT_TRUE(keeps(kept, section.points.first) && keeps(kept, section.points.last));
    EXPECT_TRUE(keeps(kept, 450));
}

TEST(KeptPoints, ChordsOfACutAreAFewStepOversAtMost) {
    const ClSurface surface = raster();
    const Lines lines;
    Field flat;
    flat.values = Column<float>(static_cast<std::size_t>(points), 1.0F);
    const KeptPoints kept = keep_points(surface, lines.map, {&flat, 1}, {}, 1200);
    for (std::size_t k = 1; k < kept.points.size(); ++k) {
        const PointIndex a = kept.points[k - 1];
        const PointIndex b = kept.points[k];
        if (a / per_pass != b / per_pass) continue;
        EXPECT_LE((surface.positions[b] - surface.positions[a]).norm(), 3 * 0.3F + 1e-4F);
    }
}

TEST(KeptPoints, WhereLinesAreAsManyAsPointsTheirStartsGiveArcLength) {
    const Lines lines;
    const std::vector<Field> fields{noise()};
    const KeptPoints kept = keep_points(raster(), lines.map, fields, {}, 800);
    EXPECT_FALSE(kept.line_starts);
    EXPECT_LE(kept.points.size(), 800U);
}

TEST(KeptPoints, APointWithoutAPositionIsLeftOut) {
    ClSurface surface = raster();
    surface.positions.x[77] = std::nanf("");
    const Lines lines;
    const std::vector<Field> fields{noise()};
    const KeptPoints kept = keep_points(surface, lines.map, fields, {}, points);
    EXPECT_EQ(kept.all, points - 1);
    EXPECT_FALSE(keeps(kept, 77));
}

}  // namespace
}  // namespace clsurf::kept_points_test
