// Paths of balls over profiles with a known offset, and programs in every dialect, read back.

#include "scan/cut_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/error.h"
#include "io/readers/program_file.h"
#include "program/dialect.h"
#include "scan/cut_program.h"
#include "scan/read_back.h"
#include "scan/scan_cut.h"

namespace clsurf::cut_path_test {
namespace {

Program read_text(const std::string& text, std::string_view dialect) {
    const auto kept = std::make_shared<const std::string>(text);
    io::ProgramOptions options;
    options.dialect = dialect;
    return io::read_program({"cut", std::as_bytes(std::span(kept->data(), kept->size())), kept}, options);
}

/// z = x² / 2 from −3 to 3: radius 1 at its lowest point.
WindowedFit parabola() { return {{{-3, 3, {4.5, -4.5, 4.5}}}}; }

TEST(CutPath, ABallTouchesAnInclinedLineBesideItsTip) {
    // Slope 3/4: the centre is 5 · (−3/5, 4/5) from the contact, the tip 5 below it.
    const CutPath path({{{0, 8, {0, 6}}}}, 5, 0.01);
    const std::vector<Vec2> points = path.points();
    ASSERT_EQ(points.size(), 2U);
    EXPECT_NEAR((points[0] - Vec2(-3, -1)).norm(), 0, 1e-12);
    EXPECT_NEAR((points[1] - Vec2(5, 5)).norm(), 0, 1e-12);
}

TEST(CutPath, ABallThatIsTooLargeIsSeen) {
    EXPECT_FALSE(CutPath(parabola(), 0.95, 0.001).gouge());
    const std::optional<Gouge> gouge = CutPath(parabola(), 1.5, 0.001).gouge();
    ASSERT_TRUE(gouge);
    EXPECT_NEAR(gouge->least_radius, 1, 1e-3);
    // A ball of radius r on the lowest point: r − √(2 r − 1) below the parabola.
    EXPECT_GE(gouge->depth, 1.5 - std::sqrt(2.0) - 1e-3);
    // Two slopes that face each other across a smooth bottom, each wide enough by itself.
    EXPECT_THROW((void)scan_cut("v", std::vector<ScanPoint>{{0, 9}, {1, 4}, {2, 1}, {3, 0}, {4, 1}, {5, 4}, {6, 9}},
                                {0, {2, 7, WindowJoin::c1}, 3, 0.01}),
                 InputError);
}

TEST(CutPath, LinesAndSplinesStayWithinTheTolerance) {
    for (const double radius : {0.0, 0.8}) {
        for (const double tolerance : {0.1, 0.01, 0.001}) {
            const CutPath path(parabola(), radius, tolerance);
            const std::vector<Vec2> points = path.points();
            // The chord error of a length l on a parabola with second derivative 1 is l²/8 cos, less on a slope.
            if (radius == 0) {
                EXPECT_GE(points.size(), 1 + static_cast<std::size_t>(6 / std::sqrt(8 * tolerance * std::sqrt(10))));
                EXPECT_LE(points.size(), 3 + static_cast<std::size_t>(6 / std::sqrt(8 * tolerance * 0.8)));
            }
            double most = 0, most_of_spans = 0;
            const std::vector<CutSpan> spans = path.spans();
            for (int i = 0; i <= 750; ++i) {
                const double x = -3 + 0.008 * i, scale = radius / std::sqrt(1 + x * x);
                const Vec2 exact(x - scale * x, x * x / 2 + scale - radius);
                const auto distance = [&](const Vec2& a, const Vec2& b) {
                    const double t = std::clamp((exact - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
                    return (exact - a - t * (b - a)).norm();
                };
                double least = 1e9, least_of_spans = 1e9;
                for (std::size_t k = 0; k + 1 < points.size(); ++k)
                    least = std::min(least, distance(points[k], points[k + 1]));
                for (const CutSpan& span : spans) {
                    for (int n = 0; n < 256; ++n)
                        least_of_spans =
                            std::min(least_of_spans, distance(span.at(n / 256.0), span.at((n + 1) / 256.0)));
                }
                most = std::max(most, least);
                most_of_spans = std::max(most_of_spans, least_of_spans);
            }
            EXPECT_LT(most, tolerance);
            EXPECT_GT(most, 0.3 * tolerance);
            EXPECT_LT(most_of_spans, tolerance);
        }
    }
}

TEST(CutProgram, EveryDialectIsReadBackAsThePath) {
    const CutPath path(parabola(), 0.8, 0.005);
    for (const Dialect& dialect : dialects()) {
        for (const bool splines : {false, true}) {
            if (splines && !writes_spans(dialect.name)) continue;
            const CutProgramRules rules{dialect.name, "a (b) % scan", 600, 12, 2.5};
            const std::string text = splines ? span_program(path.spans(), rules) : line_program(path.points(), rules);
            const Program program = read_text(text, dialect.name);
            EXPECT_TRUE(program.diagnostics.empty()) << text;
            const ReadBack back = read_back(program, path);
            EXPECT_EQ(back.motions, splines ? path.spans().size() : path.points().size() - 1) << dialect.name;
            EXPECT_LT(back.deviation, 0.005) << dialect.name;
            const Motions& motions = program.motions;
            for (std::int64_t i = 2; i < motions.size(); ++i) {
                EXPECT_EQ(motions.end[static_cast<std::size_t>(i)].y, 2.5);
                if (!is_cut(motions.kind[static_cast<std::size_t>(i)])) continue;
                EXPECT_FLOAT_EQ(motions.feed[static_cast<std::size_t>(i)], 10);
            }
            EXPECT_EQ(motions.end[static_cast<std::size_t>(motions.size() - 1)].z, 12);
        }
    }
}

TEST(CutProgram, AProgramThatGoesElsewhereIsSeen) {
    const CutPath path(parabola(), 0, 0.005);
    std::vector<Vec2> points = path.points();
    points[points.size() / 2].y() += 0.5;
    const CutProgramRules rules{"linuxcnc", "s", 600, 12, 0};
    const Program program = read_text(line_program(points, rules), "linuxcnc");
    EXPECT_NEAR(read_back(program, path).deviation, 0.5, 0.02);
}

}  // namespace
}  // namespace clsurf::cut_path_test
