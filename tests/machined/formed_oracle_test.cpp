// Profiles from an independent z-buffer (formed_oracle.py): heights of the as-machined surface, and its roughness against
// the design, including creases.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "machined/as_machined_profile.h"
#include "machined/as_machined_report.h"
#include "machined/part_roughness.h"
#include "support/made_surface.h"

namespace clsurf::formed_oracle_test {
namespace {

constexpr double step_over = 0.3;
constexpr int passes = 25;
constexpr double length = 12;
constexpr double speed = 10;  // mm/s: a position every 10 µm

struct OracleCase {
    std::string name, kind, part;
    CuttingTool tool{};
    double a = 0, b = 0;
    double error = 0;  ///< [µm] position error of the machine
    Vec2 from, to;
    double apart = 0;                       ///< [mm] contacts of adjacent passes, in plan view
    double ra = 0, rz = 0, sa = 0, sz = 0;  ///< µm
    std::vector<double> z;
};

std::vector<OracleCase> read_cases() {
    std::ifstream file(TEST_SOURCES "/machined/formed_oracle.txt");
    std::vector<OracleCase> cases;
    std::string word;
    while (file >> word) {
        OracleCase c;
        std::size_t count = 0;
        file >> c.name >> c.kind >> c.tool.radius >> c.tool.corner >> c.part >> c.a >> c.b >> c.error >> c.from.x() >>
            c.from.y() >> c.to.x() >> c.to.y() >> c.apart >> c.ra >> c.rz >> c.sa >> c.sz >> count;
        c.tool.kind = c.kind == "ball" ? ToolKind::ball : c.kind == "bull" ? ToolKind::bull : ToolKind::flat;
        c.z.resize(count);
        for (double& height : c.z) file >> height;
        EXPECT_TRUE(file) << c.name;
        cases.push_back(c);
    }
    return cases;
}

constexpr double per_degree = 0.017453292519943295;

double tan_of(double degrees) { return std::tan(degrees * per_degree); }

/// A groove of radius r between slopes of 25°.
double groove(double r, double aside) {
    const double sine = std::sin(25 * per_degree), cosine = std::cos(25 * per_degree);
    const double off = std::abs(aside);
    return off < r * sine ? r - std::sqrt(r * r - off * off) : off * sine / cosine + r - r / cosine;
}

/// The tip's height: the formulas of formed_oracle.py.
double tip_of(const OracleCase& c, double x, double y) {
    if (c.part == "wave") return c.a * std::sin(x / c.b) + 0.5 * c.a * std::cos(y / c.b);
    const double radius = c.tool.radius;
    if (c.part == "plane") {
        const double slope = std::hypot(tan_of(c.a), tan_of(c.b));
        return tan_of(c.b) * x + tan_of(c.a) * y + (radius - c.tool.corner) * slope +
               c.tool.corner * (std::hypot(1, slope) - 1);
    }
    const double direction = c.a * per_degree;
    const double aside = (x - 6.0) * -std::sin(direction) + (y - 3.6) * std::cos(direction);
    if (c.part == "cylinder") {
        const double r = c.b + radius;  // radius of the path of the ball's centre; < 0: a groove
        return std::copysign(std::sqrt(r * r - aside * aside), c.b) - r;
    }
    if (c.part == "fillet") return groove(std::max(c.b, radius) - radius, aside);
    const double steepness = c.b * per_degree;
    const double off = std::abs(aside);
    if (off <= radius * std::sin(steepness)) return std::sqrt(radius * radius - off * off) - radius;
    return radius / std::cos(steepness) - tan_of(c.b) * off - radius;
}

/// The position of the machine [mm].
Vec3 measured_of(const OracleCase& c, const Vec3& p) {
    constexpr double wave = 5, from_pass_to_pass = 2;
    const double phase = from_pass_to_pass * std::round(p.y() / step_over);
    return p + Vec3(0, 0, 1e-3 * c.error * std::sin(2 * M_PI * p.x() / wave + phase));
}

/// Whether the path has corners, in a valley without a fillet: smoothing rounds the positions by up to 7 µm, and
/// the passes in between are not those of the program there (docs/formed.md, limits).
bool has_corner(const OracleCase& c) { return c.part == "fillet" && c.b == 0; }

/// The passes of a case, and the as-machined surface.
struct CutPart {
    test::MadeSurface made;
    Signals signals;
    std::vector<PointRange> pieces;
    AsMachinedSurface as_machined;

    explicit CutPart(const OracleCase& c)
        : made(test::flat_zigzag(
              passes, length, step_over, speed, [&](const Vec3& p, const Vec3&) { return measured_of(c, p); },
              [&](const Vec3& p) { return Vec3(p.x(), p.y(), tip_of(c, p.x(), p.y())); })),
          signals(made.signals()),
          pieces(pieces_of(made)),
          as_machined(made.surface, signals, Role::commanded, made.measured, pieces, c.tool) {}

    static std::vector<PointRange> pieces_of(const test::MadeSurface& made) {
        std::vector<PointRange> ranges;
        for (const Pass& pass : made.surface.passes) ranges.push_back({pass.first, pass.last});
        return ranges;
    }
};

TEST(FormedOracle, HeightsAreThoseOfAnIndependentZBuffer) {
    const std::vector<OracleCase> cases = read_cases();
    ASSERT_GE(cases.size(), 24U);
    for (const OracleCase& c : cases) {
        if (has_corner(c)) continue;
        const CutPart part(c);
        const auto count = static_cast<std::int64_t>(c.z.size());
        // Every sixteenth point of a profile with steps of about 1.5 µm.
        const Vec2 arc_length = c.to - c.from;
        const double step = 16 * arc_length.norm() / std::round(arc_length.norm() / 0.0015);
        double most = 0;
        part.as_machined.map({c.from, arc_length.normalized(), step, count, 1},
                             [&](std::int64_t, std::span<float> row) {
                                 for (std::size_t k = 0; k < row.size(); ++k) {
                                     const double off = std::abs(row[k] + part.as_machined.level() - c.z[k]);
                                     most = std::isfinite(off) ? std::max(most, off) : 1.0;
                                 }
                             });
        EXPECT_LE(most, 0.0002) << c.name << " " << c.kind;
    }
}

TEST(FormedOracle, RoughnessIsThatOfTheDistanceToTheDesignCreasesIncluded) {
    for (const OracleCase& c : read_cases()) {
        if (c.ra == 0 || has_corner(c)) continue;
        const std::string what = c.name + " " + c.kind;
        const CutPart part(c);
        const AsMachinedProfile profile = measure_profile(part.as_machined, c.from, c.to);
        EXPECT_NEAR(1e3 * profile.roughness.ra, c.ra, 0.03 * c.ra) << what;
        EXPECT_NEAR(1e3 * profile.roughness.rz, c.rz, 0.03 * c.rz) << what;
        EXPECT_GT(profile.step * static_cast<double>(profile.count), 0.97 * (c.to - c.from).norm()) << what;
        const Vec2 middle = 0.5 * (c.from + c.to);
        const RoughnessPlace place{
            0, Vec3(middle.x(), middle.y(), 0), {middle, Vec2::UnitY(), step_over, true}, c.apart};
        const PartRoughness area = measure_roughness({part.as_machined, part.as_machined}, std::span(&place, 1));
        ASSERT_EQ(area.patches.size(), 1U) << what;
        EXPECT_EQ(area.unknown, 0) << what;
        EXPECT_NEAR(1e3 * area.sa, c.sa, 0.03 * c.sa) << what;
        EXPECT_NEAR(1e3 * area.sz, c.sz, 0.03 * c.sz) << what;
    }
}

TEST(FormedOracle, ScallopsInClosedFormAreTheCuspsThatTheZBufferLeaves) {
    int compared = 0;
    for (const OracleCase& c : read_cases()) {
        if (c.kind != "ball" || c.error > 0 || (c.part != "plane" && c.part != "cylinder")) continue;
        const CutPart part(c);
        // The passes are evenly spaced in plan view: on the flanks of rod and groove they are up to 4 % farther apart than in
        // the middle, where the square for Sz is. If the curvature were neglected the error would be 25 %.
        EXPECT_NEAR(1e3 * usual_scallop(part.as_machined, part.signals), c.sz, 0.045 * c.sz) << c.name;
        ++compared;
    }
    EXPECT_GE(compared, 5);
}

}  // namespace
}  // namespace clsurf::formed_oracle_test
