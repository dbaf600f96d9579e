// Sections as splines: the fit, the blocks of each dialect, and reading them back. Expected values are computed by hand;
// tests/cli/cases/optimize_splines.cmake evaluates whole programs with SciPy.

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "repair/line_edit.h"
#include "repair/parts.h"
#include "repair/points/deviation.h"
#include "repair/points/resample.h"
#include "repair/points/section_spline.h"
#include "repair/spline_lines.h"
#include "surface/programmed_surface.h"

namespace clsurf::spline_test {
namespace {

OldSegment segment_of(const std::vector<Vec3>& points) {
    OldSegment old;
    for (const Vec3& p : points) {
        old.arc_length.push_back(old.points.empty() ? 0 : old.arc_length.back() + (p - old.points.back()).norm());
        old.points.push_back(p);
        old.motion.push_back(static_cast<std::int64_t>(old.motion.size()));
    }
    return old;
}

LineRules rules_of(double spacing) {
    LineRules rules;
    rules.spacing = rules.usual = spacing;
    rules.chord_error = 0.001;
    rules.most = 0.004;
    rules.radius = 0.003;
    return rules;
}

std::optional<Nurbs> fitted(const OldSegment& old, const LineRules& rules) {
    return section_spline(old, SmoothCurve(old, {}, rules), rules);
}

/// One span: control points (0,0) (1,2) (2,2) (3,0) over knots 0 … 3.
Nurbs one_span() { return {3, {{0, 0, 5}, {1, 2, 5}, {2, 2, 5}, {3, 0, 5}}, {1, 1, 1, 1}, {0, 0, 0, 0, 3, 3, 3, 3}}; }

Program read_as(const std::string& text, const char* dialect) {
    auto bytes = std::make_shared<std::string>(text);
    InterpreterOptions options;
    options.dialect = find_dialect(dialect);
    return parse_program(SourceText("part.nc", *bytes, bytes), options);
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

TEST(SectionSpline, OfALineIsOneSpan) {
    std::vector<Vec3> points;
    for (int k = 0; k <= 20; ++k) points.emplace_back(0.25 * k, 0.5 * k, 0);
    const std::optional<Nurbs> spline = fitted(segment_of(points), rules_of(0.3));
    ASSERT_TRUE(spline);
    EXPECT_EQ(spline->points.size(), 4U);
    for (const Vec3& p : spline->points) EXPECT_NEAR(p.y(), 2 * p.x(), 1e-6);
    EXPECT_EQ(spline->points.front(), points.front());
    EXPECT_EQ(spline->points.back(), points.back());
}

// Chords of 0.25 mm deviate from a circle of radius 10 mm by 0.8 µm. A cubic per radian deviates by less than 1 µm.
TEST(SectionSpline, OfACircleNeedsFewSpans) {
    std::vector<Vec3> points;
    for (int k = 0; k <= 80; ++k) points.emplace_back(10 * std::cos(0.025 * k), 10 * std::sin(0.025 * k), 0.1 * k);
    const OldSegment old = segment_of(points);
    const std::optional<Nurbs> spline = fitted(old, rules_of(0.25));
    ASSERT_TRUE(spline);
    EXPECT_LE(spans_in(*spline), 8U);
    for (const NurbsSpan& span : spans_of(*spline)) {
        for (double t = 0; t <= 1; t += 0.05) EXPECT_NEAR(span.curve.at(t).head<2>().norm(), 10, 0.004);
    }
}

// Points alternately 3 µm off a line can be smoothed; if only 0.1 µm is allowed, a cubic would need a span for each.
TEST(SectionSpline, GivesUpWhereSpansWouldBeAsShortAsLines) {
    std::vector<Vec3> points;
    for (int k = 0; k <= 60; ++k) points.emplace_back(0.2 * k, k % 2 == 0 ? 0.003 : -0.003, 0);
    LineRules rules = rules_of(0.2);
    EXPECT_TRUE(fitted(segment_of(points), rules));
    rules.most = rules.radius = rules.chord_error = 1e-4;
    EXPECT_FALSE(fitted(segment_of(points), rules));
}

TEST(SplineLines, AreThoseOfEachDialect) {
    const Nurbs spline = one_span();
    SplineWords words;
    words.decimals = 1;
    EXPECT_EQ(joined(spline_lines(spline, SplineForm::knotted, words)),
              "G06.2 P4 K0.000 X0.0 Y0.0 Z5.0\nK0.000 X1.0 Y2.0 Z5.0\nK0.000 X2.0 Y2.0 Z5.0\nK0.000 X3.0 Y0.0 Z5.0\n"
              "K3.000\nK3.000\nK3.000\nK3.000\nG1\n");
    EXPECT_EQ(joined(spline_lines(spline, SplineForm::basis, words)),
              "BSPLINE SD=3 X1.0 Y2.0 Z5.0 PL=3.000\nX2.0 Y2.0 Z5.0\nX3.0 Y0.0 Z5.0\nG1\n");
    EXPECT_EQ(joined(spline_lines(spline, SplineForm::cubic_plane, words)),
              "G5 X3.0 Y0.0 I1.0000 J2.0000 P-1.0000 Q2.0000\nG1\n");
    words.straight.clear();
    EXPECT_EQ(joined(spline_lines(spline, SplineForm::polynomial, words)),
              "SPL X+3.0 Y+0.0 Z+5.0 K3X+0.0000 K2X+0.0000 K1X-3.0000 K3Y+0.0000 K2Y-6.0000 K1Y+6.0000 "
              "K3Z+0.0000 K2Z+0.0000 K1Z+0.0000\n");
    for (const SplineForm form : {SplineForm::knotted, SplineForm::basis, SplineForm::cubic_plane})
        EXPECT_EQ(blocks_of_spline(spline, form), spline_lines(spline, form, {}).size());
    EXPECT_EQ(blocks_of_spline(spline, SplineForm::polynomial),
              spline_lines(spline, SplineForm::polynomial, words).size());
}

// Two spans of different length, in every dialect: the curve that is read back is the written one.
TEST(SplineLines, ReadBackAsTheSameCurve) {
    const Nurbs spline{
        3, {{0, 0, 5}, {1, 2, 5}, {2, 2, 5}, {4, 1, 5}, {5, 0, 5}}, {1, 1, 1, 1, 1}, {0, 0, 0, 0, 2, 5, 5, 5, 5}};
    const std::vector<NurbsSpan> spans = spans_of(spline);
    struct Row {
        const char *dialect, *before, *after;
        SplineForm form;
    };
    for (const Row& row : {Row{"fanuc", "G21 G90 G17 G94\nG1 X0. Y0. Z5. F600\n", "X9.\nM30\n", SplineForm::knotted},
                           Row{"siemens", "G71 G90 G17 G94\nG1 X0 Y0 Z5 F600\n", "X9\nM30\n", SplineForm::basis},
                           Row{"linuxcnc", "G21 G90 G17\nG1 X0 Y0 Z5 F600\n", "X9\nM2\n", SplineForm::cubic_plane},
                           Row{"klartext", "0 BEGIN PGM A MM\n1 L X+0 Y+0 Z+5 R0 F600\n", "L X+9\nEND PGM A MM\n",
                               SplineForm::polynomial}}) {
        SplineWords words;
        if (row.form == SplineForm::polynomial) words.straight.clear();
        const Motions motions =
            read_as(row.before + joined(spline_lines(spline, row.form, words)) + row.after, row.dialect).motions;
        ASSERT_EQ(motions.curves.size(), 2U) << row.dialect;
        for (std::size_t k = 0; k < 2; ++k) {
            for (const double t : {0.0, 0.3, 0.7, 1.0})
                EXPECT_LT((motions.curves[k].span->at(t) - spans[k].curve.at(t)).norm(), 0.001) << row.dialect;
        }
        EXPECT_EQ(motions.kind.back(), MotionKind::feed) << row.dialect;
        EXPECT_EQ(motions.end.back().x, 9) << row.dialect;
    }
}

/// A section of two spans between two lines in each dialect, and the feeds of its motions.
struct FedSection {
    const char *dialect, *before, *after;
    SplineForm form;
    std::vector<std::string> with_words;  ///< lines with an F word if a line that may be rewritten follows
    std::vector<float> feeds;             ///< [mm/s] feeds of the lines, the spans and the last line, as read back
};

const std::vector<FedSection>& fed_sections() {
    // F600 is 10 mm/s. The line before is wanted at 9, the spans at 5 and 8.
    static const std::vector<FedSection> all{
        {"fanuc",
         "G21 G90 G17 G94\nG1 X-1. Y0. Z5. F600\nX0. Y0.\n",
         "X9. Y0.\n",
         SplineForm::knotted,
         {"X0. Y0. F540", "G06.2 P4 K0.000 X0.0 Y0.0 Z5.0 F300", "X9. Y0. F600"},
         {10, 9, 5, 5, 10}},
        {"siemens",
         "G71 G90 G17 G94\nG1 X-1 Y0 Z5 F600\nX0 Y0\n",
         "X9 Y0\n",
         SplineForm::basis,
         {"X0 Y0 F540", "BSPLINE SD=3 X1.0 Y2.0 Z5.0 PL=2.000 F300", "X5.0 Y0.0 Z5.0 F480", "X9 Y0 F600"},
         {10, 9, 5, 8, 10}},
        {"linuxcnc",
         "G21 G90 G17\nG1 X-1 Y0 Z5 F600\nX0 Y0\n",
         "X9 Y0\n",
         SplineForm::cubic_plane,
         {"X0 Y0 F540", "P-0.6000 Q0.2000 F300", "Q1.0000 F480", "X9 Y0 F600"},
         {10, 9, 5, 8, 10}},
        {"klartext",
         "0 BEGIN PGM A MM\n1 L X-1 Y+0 Z+5 R0 F600\nL X+0 Y+0\n",
         "L X+9 Y+0\n",
         SplineForm::polynomial,
         {"L X+0 Y+0 F540", "K1Z+0.0000 F300", "K1Z+0.0000 F480", "L X+9 Y+0 F600"},
         {10, 9, 5, 8, 10}},
    };
    return all;
}

/// The lines of a text that end with a word.
std::vector<std::string> lines_with_feeds(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream all(text);
    for (std::string line; std::getline(all, line);) {
        if (line.find(" F") != std::string::npos) lines.push_back(line);
    }
    return lines;
}

/// Motions with a movement: in linuxcnc a G1 alone is one without.
std::vector<std::size_t> moving(const Motions& motions) {
    std::vector<std::size_t> all;
    for (std::int64_t i = 0; i < motions.size(); ++i) {
        if (i == 0 || motions.begin_of(i) != motions.end[static_cast<std::size_t>(i)])
            all.push_back(static_cast<std::size_t>(i));
    }
    return all;
}

/// The feeds of these motions, at their index; 0 elsewhere.
std::vector<float> feeds_of_moving(const Motions& motions, const std::vector<float>& feeds) {
    std::vector<float> all(static_cast<std::size_t>(motions.size()), 0);
    const std::vector<std::size_t> of = moving(motions);
    EXPECT_EQ(of.size(), feeds.size());
    for (std::size_t k = 0; k < std::min(of.size(), feeds.size()); ++k) all[of[k]] = feeds[k];
    return all;
}

void expect_feeds(const std::string& text, const char* dialect, const std::vector<float>& expected) {
    const Motions motions = read_as(text, dialect).motions;
    const std::vector<std::size_t> of = moving(motions);
    ASSERT_EQ(of.size(), expected.size()) << text;
    for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_FLOAT_EQ(motions.feed[of[k]], expected[k]) << text;
}

std::vector<std::uint8_t> all_of(const Program& program) {
    return std::vector<std::uint8_t>(static_cast<std::size_t>(program.motions.size()), 1);
}

std::string section_text(const FedSection& row, double x = 0) {
    Nurbs spline{
        3, {{0, 0, 5}, {1, 2, 5}, {2, 2, 5}, {4, 1, 5}, {5, 0, 5}}, {1, 1, 1, 1, 1}, {0, 0, 0, 0, 2, 5, 5, 5, 5}};
    for (Vec3& point : spline.points) point.x() += x;
    SplineWords words;
    words.decimals = 1;
    if (row.form == SplineForm::polynomial) words.straight.clear();
    return joined(spline_lines(spline, row.form, words));
}

TEST(LineEditor, SetsFeedsOfSpans) {
    for (const FedSection& row : fed_sections()) {
        const bool klartext = row.form == SplineForm::polynomial;
        const std::string end = klartext ? "L M30\nEND PGM A MM\n" : "M30\n";
        const Program program = read_as(row.before + section_text(row) + row.after + end, row.dialect);
        LineEditor editor(program);
        editor.set_feeds(feeds_of_moving(program.motions, {0, 9, 5, 8, 0}), all_of(program));
        const std::string text = editor.text("");
        std::vector<std::string> lines = lines_with_feeds(text);
        ASSERT_EQ(lines.size(), row.with_words.size() + 1) << text;
        for (std::size_t k = 0; k < row.with_words.size(); ++k)
            EXPECT_TRUE(lines[k + 1].ends_with(row.with_words[k])) << lines[k + 1] << "\n" << row.with_words[k];
        expect_feeds(text, row.dialect, row.feeds);
        const Motions again = read_as(text, row.dialect).motions;
        for (std::size_t k = 0; k < 2; ++k) {
            for (const double t : {0.0, 0.4, 1.0})
                EXPECT_EQ(again.curves[k].span->at(t), program.motions.curves[k].span->at(t)) << row.dialect;
        }
    }
}

// The line after the section may not be rewritten: G1 sets the feed again, after SPL a separate line does. For G06.2 that
// is after the last knots.
TEST(LineEditor, SetsTheProgrammedFeedBehindASpline) {
    for (const FedSection& row : fed_sections()) {
        const bool klartext = row.form == SplineForm::polynomial;
        const std::string end = klartext ? "L M8\nL X+9 Y+0\nEND PGM A MM\n" : "M8\nX9. Y0.\nM30\n";
        const Program program = read_as(row.before + section_text(row) + end, row.dialect);
        LineEditor editor(program);
        editor.set_feeds(feeds_of_moving(program.motions, {0, 0, 5, 5, 0}), all_of(program));
        const std::string text = editor.text("");
        EXPECT_NE(text.find(klartext ? "F300\nSPL" : "\nG1 F600\nM8"), std::string::npos) << text;
        if (klartext) { EXPECT_NE(text.find("\nL F600\nL M8"), std::string::npos) << text; }
        expect_feeds(text, row.dialect, {10, 10, 5, 5, 10});
    }
}

// Two consecutive sections, each with a feed.
TEST(LineEditor, SetsFeedsOfSectionsThatFollowEachOther) {
    for (const FedSection& row : fed_sections()) {
        const bool klartext = row.form == SplineForm::polynomial;
        const std::string back = klartext ? "L X+0 Y+0\n" : "X0. Y0.\n", end = klartext ? "END PGM A MM\n" : "M30\n";
        const Program program =
            read_as(row.before + section_text(row) + back + section_text(row) + back + end, row.dialect);
        LineEditor editor(program);
        editor.set_feeds(feeds_of_moving(program.motions, {0, 0, 5, 5, 6, 7, 7, 0}), all_of(program));
        expect_feeds(editor.text(""), row.dialect, {10, 10, 5, 5, 6, 7, 7, 10});
    }
}

// The second section begins where the first one ends: in no dialect do they become one spline.
TEST(LineEditor, SetsFeedsOfSectionsWithNothingBetween) {
    for (const FedSection& row : fed_sections()) {
        const bool klartext = row.form == SplineForm::polynomial;
        const std::string back = klartext ? "L X+0 Y+0\n" : "X0. Y0.\n", end = klartext ? "END PGM A MM\n" : "M30\n";
        const Program program =
            read_as(row.before + section_text(row) + section_text(row, 5) + back + end, row.dialect);
        ASSERT_EQ(moving(program.motions).size(), 7U) << row.dialect;
        EXPECT_NEAR(program.motions.curves[1].span->at(1).x(), 5, 1e-9) << row.dialect;
        EXPECT_NEAR(program.motions.curves[3].span->at(1).x(), 10, 1e-9) << row.dialect;
        LineEditor editor(program);
        editor.set_feeds(feeds_of_moving(program.motions, {0, 0, 5, 5, 7, 7, 0}), all_of(program));
        expect_feeds(editor.text(""), row.dialect, {10, 10, 5, 5, 7, 7, 10});
    }
}

// Splines of the original program are kept byte for byte, even if the line before them gets a feed.
TEST(LineEditor, SetsNoFeedsOfSplinesThatItDidNotWrite) {
    for (const FedSection& row : fed_sections()) {
        const std::string section = section_text(row);
        const bool klartext = row.form == SplineForm::polynomial;
        const Program program =
            read_as(row.before + section + row.after + (klartext ? "END PGM A MM\n" : "M30\n"), row.dialect);
        std::vector<std::uint8_t> lines_alone = all_of(program);
        lines_alone[2] = lines_alone[3] = 0;
        for (const std::vector<std::uint8_t>& spans : {std::vector<std::uint8_t>{}, lines_alone}) {
            LineEditor editor(program);
            editor.set_feeds(feeds_of_moving(program.motions, {0, 9, 5, 8, 0}), spans);
            EXPECT_NE(editor.text("").find(section), std::string::npos) << editor.text("");
        }
    }
}

TEST(LineEditor, WritesG5InPlanesOfConstantZOnly) {
    const Program program = read_as("G21 G90\nG0 X0 Y0 Z0\nG1 X1 F600\nX2\nX3\nX4\nX5 Z1\nM2\n", "linuxcnc");
    const LineEditor editor(program);
    EXPECT_TRUE(editor.may_be_spline(2, {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}));
    EXPECT_FALSE(editor.may_be_spline(2, {{1, 0, 0}, {4, 0, 0}, {5, 0, 1}}));
    // G5 needs G17.
    const Program turned = read_as("G21 G90\nG18\nG0 X0 Y0 Z0\nG1 X1 F600\nX2\nX3\nM2\n", "linuxcnc");
    EXPECT_FALSE(LineEditor(turned).may_be_spline(2, {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}));
    const Program fanuc = read_as("G21 G90 G94\nG0 X0. Y0. Z0.\nG1 X1. F600\nX2.\nX5. Z1.\nM30\n", "fanuc");
    EXPECT_TRUE(LineEditor(fanuc).may_be_spline(2, {{1, 0, 0}, {5, 0, 1}}));
}

// A Bézier curve with inner points at a distance h from its chord deviates from it by at most 3/4 h.
TEST(Deviation, OfASplineInPlaceOfALine) {
    const Program line = read_as("G21 G90 G17\nG0 X0 Y0 Z0\nG1 X10 F600\nX20\nX30\nM2\n", "linuxcnc");
    const Program spline =
        read_as("G21 G90 G17\nG0 X0 Y0 Z0\nG1 F600\nG5 X30 Y0 I10 J0.02 P-10 Q0.02\nM2\n", "linuxcnc");
    const Deviation deviation = measure_deviation(line, spline);
    EXPECT_EQ(deviation.disordered, 0U);
    EXPECT_NEAR(deviation.greatest, 0.015, 1e-6);
}

/// How many of the sections of a program get more lines than before.
int growing_sections(const std::string& text, bool splines) {
    const Program program = read_as(text, "linuxcnc");
    const LineEditor editor(program);
    const ResampleRules rules{0.005, 0.25, 0.001, 0, 0, splines};
    int growing = 0;
    for (const ResampledSegment& s : resample(program, build_programmed_surface(program), editor, rules, {}, nullptr)) {
        EXPECT_FALSE(s.spline);
        if (static_cast<std::int64_t>(s.points.size()) > s.last - s.first + 1) ++growing;
    }
    return growing;
}

// LinuxCNC has no splines for passes on which Z moves, and straight lines over this wave have to be shorter than those of the
// program.
TEST(Splines, WhereThereIsNoneLinesDoNotBecomeMore) {
    const std::string text = wavy_zigzag(3, 9, [](int, double) { return 0.5; });
    EXPECT_GT(growing_sections(text, false), 0);
    EXPECT_EQ(growing_sections(text, true), 0);
}

}  // namespace
}  // namespace clsurf::spline_test
