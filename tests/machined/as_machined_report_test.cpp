#include "machined/as_machined_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "machined/as_machined_profile.h"
#include "machined/form.h"
#include "machined/scallop.h"
#include "mapping/map_lines.h"
#include "planted_score.h"
#include "support/scallop_roughness.h"
#include "surface/smoothing_segments.h"
#include "surface/stitch.h"

namespace clsurf::as_machined_report_test {
namespace {

/// A planted log with its as-machined surface.
struct Planted {
    /// `programmed`: the positions in the program, in case the program itself has the fault.
    explicit Planted(const planted::Recipe& recipe, Role programmed = Role::commanded)
        : made(planted::make_planted_log(recipe)), path(reconstruct(log, programmed, Vec3::Zero())) {}

    planted::PlantedLog made;
    Log log = planted::as_log(made);
    Program program = planted::program_of(made);
    Diagnostics diagnostics;
    Trajectory path;
    Trajectory measured = reconstruct(log, Role::feedback, Vec3::Zero());
    LineMap lines = map_lines(path, log, program, true, diagnostics);
    ClSurface surface = stitch(gather(path), lines);
    std::vector<PointRange> pieces = smoothing_segments(log, surface.passes);
    Signals signals = derive_signals(surface, path, &measured, pieces, 1.0);
    QualityReport report = find_defects(surface, signals, lines, program, log.period, {});
    AsMachinedSurface as_machined{
        surface, signals, Role::commanded, measured, pieces, {ToolKind::ball, 3, 3}, {surface, signals, report}};
    AsMachinedReport result = measure_as_machined(as_machined, signals, report);
};

planted::Recipe recipe_with(double amplitude, planted::Shape shape, planted::Surface surface) {
    planted::Recipe recipe;
    recipe.shape = shape;
    recipe.surface = surface;
    planted::Defect defect;
    defect.kind = planted::Kind::lag;
    defect.first_pass = defect.last_pass = 14;
    defect.from = 10;
    defect.to = 13;
    defect.amplitude = amplitude;
    if (amplitude != 0) recipe.defects.push_back(defect);
    return recipe;
}

TEST(AsMachinedReport, APlantedPitOfFiveMicrometresShowsAsFive) {
    // On the loops, the compliance of the axes makes the passes gradually lower across the pit.
    for (const planted::Shape shape : {planted::Shape::zigzag, planted::Shape::one_way, planted::Shape::loops}) {
        const Planted pit(recipe_with(-0.005, shape, planted::Surface::transition));
        ASSERT_GE(pit.report.defects.size(), 1U) << planted::name_of(shape);
        EXPECT_TRUE(pit.report.defects[0].pit);
        EXPECT_NEAR(pit.result.marks[0].depth, 0.005, 0.0005)
            << planted::name_of(shape) << ", found " << pit.report.defects[0].depth;
    }
}

TEST(AsMachinedReport, APlantedBulgeIsCutDownByItsNeighbours) {
    const double h = scallop_height(3, 0.3, std::numeric_limits<double>::infinity());
    const Planted bulge(recipe_with(0.006, planted::Shape::zigzag, planted::Surface::transition));
    ASSERT_EQ(bulge.report.defects.size(), 1U);
    // The cusps of the bulge are h (1 + δ/4h)² high, those next to it h: less than half of the 6 µm remain above them.
    const double cusp = h * (1 + 0.006 / (4 * h)) * (1 + 0.006 / (4 * h));
    EXPECT_NEAR(bulge.result.marks[0].depth, cusp - h, 0.0006);
}

TEST(AsMachinedReport, AMarkOfTheProgramIsOneOfTheSameDepthAsOneOfTheMachine) {
    // The program has a pass 8 µm higher or lower, and the machine follows it; or the program has no fault, and the machine
    // deviates: the part is the same.
    const double h = scallop_height(3, 0.3, std::numeric_limits<double>::infinity());
    const double off = 0.008;
    const double bulge = h * (1 + off / (4 * h)) * (1 + off / (4 * h)) - h;
    for (const double amplitude : {off, -off}) {
        planted::Recipe recipe = recipe_with(amplitude, planted::Shape::zigzag, planted::Surface::transition);
        recipe.height = 0;
        recipe.quantum = 1e-6;
        recipe.noise = 0;
        recipe.give = 0;
        recipe.delay = 0;
        const Planted of_machine(recipe), of_program(recipe, Role::feedback);
        const double expected = amplitude > 0 ? bulge : off;
        for (const Planted* each : {&of_machine, &of_program}) {
            ASSERT_EQ(each->report.defects.size(), 1U);
            EXPECT_EQ(each->report.defects[0].pit, amplitude < 0);
            EXPECT_NEAR(each->result.marks[0].depth, expected, 0.0004);  // the form is slightly curved
            EXPECT_EQ(each->result.marks[0].note, amplitude > 0 ? MarkNote::cut_away : MarkNote::none);
        }
        EXPECT_NEAR(of_machine.result.marks[0].depth, of_program.result.marks[0].depth, 0.0002);
        // A profile across the passes, above the form.
        const Vec2 middle = of_machine.surface.positions.absolute(of_machine.report.defects[0].point).head<2>();
        const Vec2 aside(0, 1.5);
        const AsMachinedProfile a = measure_profile(of_machine.as_machined, middle - aside, middle + aside);
        const AsMachinedProfile b = measure_profile(of_program.as_machined, middle - aside, middle + aside);
        ASSERT_EQ(a.deviation.size(), b.deviation.size());
        for (std::size_t k = 0; k < a.deviation.size(); ++k) EXPECT_NEAR(a.deviation[k], b.deviation[k], 0.0002) << k;
        EXPECT_NEAR(a.roughness.rz, b.roughness.rz, 0.0002);
    }
}

TEST(AsMachinedReport, RoughnessOfACleanPartIsThatOfItsScallops) {
    for (const planted::Surface surface : {planted::Surface::transition, planted::Surface::wave}) {
        planted::Recipe recipe = recipe_with(0, planted::Shape::zigzag, surface);
        recipe.noise = 0;
        recipe.give = 0;
        const Planted clean(recipe);
        const double h = scallop_height(3, 0.3, std::numeric_limits<double>::infinity());
        EXPECT_GT(clean.result.roughness.patches.size(), 15U);
        const std::vector<RoughPatch>& patches = clean.result.roughness.patches;
        double mean = 0;
        for (const RoughPatch& patch : patches) {
            mean += patch.profile.rz / static_cast<double>(patches.size());
            EXPECT_LE(patch.profile.rz, patches[clean.result.roughness.roughest].profile.rz);
            EXPECT_NEAR((patch.contact - clean.as_machined.contact(patch.point)).norm(), 0, 1e-12);
        }
        EXPECT_NEAR(mean, clean.result.roughness.rz, 1e-12);
        EXPECT_NEAR(clean.result.roughness.rz, h,
                    0.15 * h);  // the curvature of the surface adds 4 %, the log's resolution of 1 µm the rest
        EXPECT_NEAR(clean.result.roughness.ra, test::scallop_ra(h), 0.1 * test::scallop_ra(h));
        EXPECT_NEAR(clean.result.roughness.sa, test::scallop_ra(h), 0.1 * test::scallop_ra(h));
    }
}

TEST(AsMachinedReport, ScallopsFollowTheCurvatureAcrossTheFeed) {
    // Tips on a sphere of radius r: the ball's centres are on an equal one, and it touches a sphere of r − 3 mm.
    planted::Recipe recipe = recipe_with(0, planted::Shape::one_way, planted::Surface::dome);
    recipe.noise = 0;
    recipe.give = 0;
    const Planted dome(recipe);
    const double tips = 1.3 * std::hypot(0.5 * recipe.length, recipe.passes * recipe.step_over);
    const double rho = tips - 3;
    const double expected = scallop_height(3, dome.surface.step_over * rho / tips, rho);
    EXPECT_NEAR(dome.result.scallop, expected, 0.05 * expected);
    const double flat = scallop_height(3, dome.surface.step_over, std::numeric_limits<double>::infinity());
    EXPECT_GT(std::abs(dome.result.scallop - flat), 0.1 * flat);
}

TEST(AsMachinedReport, CreasesAreNoRoughness) {
    planted::Recipe recipe = recipe_with(0, planted::Shape::zigzag, planted::Surface::transition);
    recipe.noise = 0;
    recipe.give = 0;
    recipe.height = 2;
    recipe.width = 0.2;  // two bends of some 0.2 mm, less than the step-over
    const Planted creased(recipe);
    const double h = scallop_height(3, 0.3, std::numeric_limits<double>::infinity());
    EXPECT_LT(creased.result.roughness.unknown, 0.001);
    // A fit across a crease would have an error of some hundred micrometres.
    EXPECT_LT(creased.result.roughness.sz, 2 * h);
    EXPECT_NEAR(creased.result.roughness.rz, h, 0.15 * h);
}

TEST(AsMachinedReport, WithoutTheProgramTheFormOfCreasesIsNotKnown) {
    planted::Recipe recipe = recipe_with(0, planted::Shape::zigzag, planted::Surface::transition);
    recipe.noise = 0;
    recipe.give = 0;
    recipe.height = 2;
    recipe.width = 0.2;
    const Planted creased(recipe);
    const AsMachinedSurface feedback(creased.surface, creased.signals, Role::feedback, creased.measured, creased.pieces,
                                     {ToolKind::ball, 3, 3});
    const AsMachinedReport result = measure_as_machined(feedback, creased.signals, creased.report);
    const double h = scallop_height(3, 0.3, std::numeric_limits<double>::infinity());
    EXPECT_GT(result.roughness.unknown, 0.02);
    EXPECT_LT(result.roughness.unknown, 0.5);
    EXPECT_LT(result.roughness.sz, 2 * h);
    EXPECT_NEAR(result.roughness.rz, h, 0.15 * h);
}

TEST(AsMachinedReport, AMarkAmongPassesToAndFroIsReadAgainstItsOwnDirection) {
    // Thirteen passes, every second one 0.04 mm lower, and the one in the middle, of the lower ones, 0.01 mm lower than these.
    std::vector<double> z;
    for (int k = 0; k < 1300; ++k) z.push_back((k / 100 % 2 == 0 ? -0.04 : 0) - (k / 100 == 6 ? 0.01 : 0));
    EXPECT_NEAR(mark_depth(z, 0.01, 1, true).depth, 0.01, 1e-12);
    // If all passes differ by more than the mark, there is no level from which to measure it.
    const double off[] = {0, 0.03, -0.02, 0.05, -0.04, 0.01, 0, 0.06, 0.03, -0.05, 0.02, -0.01, 0.04};
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = off[k / 100] - (k / 100 == 6 ? 0.01 : 0);
    const AsMachinedMark uneven = mark_depth(z, 0.01, 1, true);
    EXPECT_TRUE(std::isnan(uneven.depth));
    EXPECT_EQ(uneven.note, MarkNote::uneven_passes);
}

TEST(AsMachinedReport, AMarkIsReadAgainstTheUsualValleysAndCusps) {
    // Eleven pieces of a parabola, 4 high; the middle one is 3 lower, and one at its edge 2 higher.
    std::vector<double> z;
    for (int k = 0; k <= 1100; ++k) {
        const double x = (k % 100) / 50.0 - 1;
        z.push_back(4 * x * x);
    }
    const std::vector<double> clean = z;
    EXPECT_NEAR(mark_depth(clean, 0.01, 1, true).depth, 0, 1e-12);
    EXPECT_NEAR(mark_depth(clean, 0.01, 1, false).depth, 0, 1e-12);
    for (std::size_t k = 500; k < 600; ++k) z[k] -= 3;
    EXPECT_NEAR(mark_depth(z, 0.01, 1, true).depth, 3, 1e-12);
    z = clean;
    for (std::size_t k = 500; k < 600; ++k) z[k] += 2;
    EXPECT_NEAR(mark_depth(z, 0.01, 1, false).depth, 2, 1e-12);
    // A linear trend across the row is not part of the mark.
    for (std::size_t k = 0; k < z.size(); ++k) z[k] += 0.005 * static_cast<double>(k);
    EXPECT_NEAR(mark_depth(z, 0.01, 1, false).depth, 2, 0.5);
    // A mark far from the middle is a different mark.
    z = clean;
    for (std::size_t k = 100; k < 200; ++k) z[k] -= 3;
    EXPECT_NEAR(mark_depth(z, 0.01, 1, true).depth, 0, 1e-12);
    const AsMachinedMark nothing = mark_depth(std::vector<double>(1100, std::nan("")), 0.01, 1, true);
    EXPECT_TRUE(std::isnan(nothing.depth));
    EXPECT_EQ(nothing.note, MarkNote::unknown_form);
}

TEST(Form, OnACurvedSurfaceItPassesThroughTheContacts) {
    const Planted clean(recipe_with(0, planted::Shape::zigzag, planted::Surface::wave));
    const Form form(clean.as_machined, clean.as_machined.bounds(), Form::Of::contacts);
    std::vector<double> off;
    for (const auto& [p, tip] : clean.as_machined.contacts(clean.as_machined.bounds(), 0.3)) {
        const Form::Facet facet = form.at(p.head<2>());
        if (facet.z == facet.z) off.push_back(std::abs(facet.z + clean.as_machined.level() - p.z()));
    }
    ASSERT_GT(off.size(), 1000U);
    std::sort(off.begin(), off.end());
    EXPECT_LT(off[off.size() / 2], 0.0005);  // the log has a resolution of 1 µm
    EXPECT_LT(off[off.size() * 99 / 100], 0.0015);
    EXPECT_TRUE(std::isnan(form.at(Vec2(12, -1)).z));  // outside the outermost pass
}

}  // namespace
}  // namespace clsurf::as_machined_report_test
