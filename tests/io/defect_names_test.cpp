#include "io/reports/defect_names.h"

#include <gtest/gtest.h>

namespace clsurf::io::defect_names_test {
namespace {

DefectSection run_of(std::int64_t pass, LineNumber first, LineNumber last, PointRange points = {0, 9}) {
    DefectSection run;
    run.pass = pass;
    run.points = points;
    run.first_line = first;
    run.last_line = last;
    return run;
}

Defect slow(std::int64_t pass, double mismatch, float score) {
    Defect d;
    d.quantity = Quantity::speed;
    d.speed_mismatch = mismatch;
    d.score = score;
    d.sections = {run_of(pass, 10 * pass, 10 * pass + 5)};
    return d;
}

TEST(Label, TellsPlaceCauseAndDepth) {
    Defect d;
    d.place.tip = Vec3(1.46, -4.66, -0.04);
    d.cause = Cause::point_spacing;
    EXPECT_EQ(place_label(d), "X 1.5  Y −4.7  Z 0.0");
    EXPECT_EQ(cause_label(d), "point spacing");
    d.depth = 0.00123;
    EXPECT_EQ(cause_label(d), "point spacing, 1.2 µm high");
    d.pit = true;
    EXPECT_EQ(cause_label(d), "point spacing, 1.2 µm deep");
    d.systematic = true;
    EXPECT_EQ(cause_label(d), "point spacing, ±1.2 µm");
    d.systematic = false;
    d.place.contact = Vec3(2, 3, 4);
    EXPECT_EQ(place_label(d), "X 2.0  Y 3.0  Z 4.0") << "the place on the part";
}

TEST(Headline, CountsThePassesOfOneKind) {
    QualityReport report;
    report.defects = {slow(2, -0.87, 10), slow(4, -0.82, 9), slow(6, -0.85, 8)};
    EXPECT_EQ(headline_of(report), "Three passes run 82 to 87 % slower than their neighbours");
}

TEST(Headline, LeavesOutWhatIsLessThanHalfAsStrongOrOfAnotherKind) {
    QualityReport report;
    Defect lag = slow(9, 0, 9);
    lag.quantity = Quantity::normal_deviation;
    report.defects = {slow(2, -0.40, 10), lag, slow(4, 0.50, 9), slow(6, -0.20, 4)};
    EXPECT_EQ(headline_of(report), "Pass 2 runs 40 % slower than its neighbours");
}

TEST(Headline, SaysWhoLeavesTheProgram) {
    QualityReport report;
    Defect d = slow(3, 0, 10);
    d.quantity = Quantity::relief;
    d.depth = 0.009;
    report.defects = {d};
    EXPECT_EQ(headline_of(report), "Pass 3 is 9.0 µm off its neighbours in the program");
    report.defects[0].cause = Cause::path_tolerance;
    EXPECT_EQ(headline_of(report), "The controller leaves the program: pass 3 runs 9.0 µm off its neighbours");
    d.sections[0].pass = 5;
    report.defects.push_back(d);
    EXPECT_EQ(headline_of(report), "The controller leaves the program: pass 3 runs 9.0 µm off its neighbours")
        << "the fifth pass is off in the program";
    report.defects[1].cause = Cause::path_tolerance;
    EXPECT_EQ(headline_of(report), "The controller leaves the program: 2 passes run 9.0 µm off their neighbours");
}

TEST(Headline, NamesSystematicLagFirst) {
    QualityReport report;
    Defect d;
    d.quantity = Quantity::normal_deviation;
    d.systematic = true;
    d.depth = 0.067;
    d.share = 0.31;
    report.defects = {d};
    EXPECT_EQ(headline_of(report), "The axes lag: adjacent passes differ by up to ±67 µm on 31 % of the part");
}

TEST(Headline, DoesNotClearAPartThatWasNotJudged) {
    QualityReport report;
    EXPECT_EQ(headline_of(report), "No defects");
    report.judgement.refuse("Too few points could be compared.");
    EXPECT_EQ(headline_of(report), "Not judged");
}

TEST(Label, SaysWhichWay) {
    EXPECT_EQ(label_of(slow(1, -0.874, 1)), "−87 % speed");
    EXPECT_EQ(label_of(slow(1, 0.25, 1)), "+25 % speed");
    Defect d;
    d.quantity = Quantity::relief;
    d.depth = 0.0121;
    EXPECT_EQ(label_of(d), "+12.1 µm relief");
    d.pit = true;
    EXPECT_EQ(label_of(d), "−12.1 µm relief");
    d.quantity = Quantity::normal_deviation;
    d.systematic = true;
    EXPECT_EQ(label_of(d), "±12.1 µm lag");
}

TEST(LinesLabel, NamesTheStrongestSection) {
    Defect d = slow(1, -0.5, 1);
    EXPECT_EQ(lines_label(d), "lines 10–15");
    d.sections = {run_of(1, 10, 15, {0, 9}), run_of(2, 20, 20, {10, 19}), run_of(3, 30, 31, {20, 29})};
    d.point = 12;
    EXPECT_EQ(lines_label(d), "line 20, 3 sections");
    d.sections = {run_of(1, 0, 0)};
    EXPECT_EQ(lines_label(d), "") << "a log without lines";
}

}  // namespace
}  // namespace clsurf::io::defect_names_test
