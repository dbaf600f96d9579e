// Recorded logs, displaced and rotated by a known pose that the log does not state.
#include "mapping/work_offset.h"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/formats/log_format.h"
#include "io/readers/program_file.h"
#include "program/frame_placement.h"
#include "program/motion_rows.h"
#include "toolpath/toolpath.h"

namespace clsurf::work_offset_test {
namespace {

struct Sample {
    const char *program, *log;
};

/// The positions are where the trajectory's pose puts them; the identity is right.
const Vec3 displaced(312.5, -48.125, -101.3);

Eigen::Isometry3d turned_by(double degrees) { return pose_of(displaced, degrees); }

/// The distance between the found and the true position of a point 100 mm from the zero [mm].
double error_of(const Eigen::Isometry3d& found, const Eigen::Isometry3d& put) {
    const Eigen::Isometry3d left = found * put;
    return left.translation().norm() + 100 * (left.linear() - Eigen::Matrix3d::Identity()).norm();
}

struct Displaced {
    Program program;
    Log log;
    Eigen::Isometry3d put;
    Trajectory path;
    explicit Displaced(const Sample& sample, double degrees = 0)
        : program(io::read_program(std::string(SAMPLE_DATA "/programs/") + sample.program)),
          log(io::open_log(std::string(SAMPLE_LOGS "/") + sample.log, {})),
          put(turned_by(degrees)),
          path(reconstruct(log, Role::commanded, Eigen::Isometry3d(put.inverse()))) {}
    /// Keeps only `count` points from `first` on.
    void cut(PointIndex first, PointIndex count) {
        for (ChannelView& axis : path.axes) {
            axis.first += static_cast<std::size_t>(first) * axis.stride;
            axis.count = count;
        }
        path.count = count;
    }
};

class WorkOffset : public testing::TestWithParam<Sample> {};

TEST_P(WorkOffset, IsFoundFromTheLinesOfTheLog) {
    for (const double degrees : {0.0, 17.5, -133.0}) {
        const Displaced made(GetParam(), degrees);
        const LineMap map(made.log.find("line")->values, made.program, made.log.keep_alive);
        const std::vector<Eigen::Isometry3d> poses = find_poses(made.path, made.program, &map);
        ASSERT_EQ(poses.size(), 1U) << degrees;
        EXPECT_LT(error_of(poses.front(), made.put), degrees == 0 ? 1e-3 : 5e-3) << degrees;
    }
}

TEST_P(WorkOffset, IsFoundByGeometryAlone) {
    for (const double degrees : {0.0, 17.5, -133.0}) {
        const Displaced made(GetParam(), degrees);
        const std::vector<Eigen::Isometry3d> poses = find_poses(made.path, made.program, nullptr);
        ASSERT_EQ(poses.size(), 1U) << degrees;
        EXPECT_LT(error_of(poses.front(), made.put), degrees == 0 ? 2e-3 : 5e-3) << degrees;
    }
}

TEST_P(WorkOffset, IsFoundFromAPartOfTheLog) {
    // The middle half, whose ends do not show where the program begins.
    Displaced made(GetParam(), 17.5);
    const LineMap map(made.log.find("line")->values, made.program, made.log.keep_alive);
    const Column<LineNumber> lines = [&] {
        Column<LineNumber> all(static_cast<std::size_t>(made.path.count / 2));
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = map.line_at(made.path.count / 4 + static_cast<PointIndex>(i));
        return all;
    }();
    made.cut(made.path.count / 4, made.path.count / 2);
    const LineMap of_part(view_of(lines), made.program, made.log.keep_alive);
    const std::vector<Eigen::Isometry3d> poses = find_poses(made.path, made.program, &of_part);
    ASSERT_EQ(poses.size(), 1U);
    EXPECT_LT(error_of(poses.front(), made.put), 1e-2);
}

TEST_P(WorkOffset, OfALogInPlaceIsNone) {
    Displaced made(GetParam());
    made.path.set_pose(Eigen::Isometry3d::Identity());
    const std::vector<Eigen::Isometry3d> poses = find_poses(made.path, made.program, nullptr);
    ASSERT_EQ(poses.size(), 1U);
    EXPECT_LT(error_of(poses.front(), Eigen::Isometry3d::Identity()), 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Recorded, WorkOffset,
                         testing::Values(Sample{"bottle_uneven.nc", "bottle_uneven.biip"},
                                         Sample{"dome_loops.nc", "dome_loops.biip"},
                                         Sample{"transition_g61.nc", "transition_g61.biip"},
                                         Sample{"petal_zigzag_g64.ngc", "petal_zigzag_g64.biip"},
                                         Sample{"petal_loops_g64.ngc", "petal_loops_g64.biip"}));

TEST(WorkOffsetRefused, ForAnotherProgram) {
    Displaced made({"petal_loops_g64.ngc", "bottle_uneven.biip"});
    EXPECT_TRUE(find_poses(made.path, made.program, nullptr).empty());
    const LineMap map(made.log.find("line")->values, made.program, made.log.keep_alive);
    EXPECT_TRUE(find_poses(made.path, made.program, &map).empty());
}

TEST(WorkOffsetRefused, WhereNothingDeterminesIt) {
    // Half of a log: without lines its box does not determine its position; with lines it is determined.
    Displaced made({"bottle_uneven.nc", "bottle_uneven.biip"});
    const LineMap map(made.log.find("line")->values, made.program, made.log.keep_alive);
    made.cut(0, made.path.count / 2);
    const std::vector<Eigen::Isometry3d> blind = find_poses(made.path, made.program, nullptr);
    const double off = blind.size() == 1 ? error_of(blind.front(), made.put) : 0.0;
    EXPECT_LT(off, 2e-3) << "a wrong offset is worse than none";
    const std::vector<Eigen::Isometry3d> seeing = find_poses(made.path, made.program, &map);
    ASSERT_EQ(seeing.size(), 1U);
    EXPECT_LT(error_of(seeing.front(), made.put), 1e-3);
    // One straight line: the position along it is not determined.
    made = Displaced({"transition_g61.nc", "transition_g61.biip"});
    made.cut(5000, 120);
    EXPECT_NE(find_poses(made.path, made.program, nullptr).size(), 1U);
}

TEST(WorkOffsetAmbiguous, ACubesEdgesFitAtEveryQuarterTurn) {
    // Squares around a centre, one below the other: four rotations fit equally well, and each is named.
    std::string text = "G21 G90\nG0 X10 Y10 Z0\nF1000\n";
    for (int level = 0; level < 5; ++level) text += fmt::format("G1 X10 Y10 Z-{0}\nX-10\nY-10\nX10\nY10\n", level);
    const Program program = parse(text + "M2\n", "linuxcnc");
    Column<double> x, y, z;
    const Eigen::Isometry3d put = turned_by(30);
    const Toolpath path(program.motions, Vec3::Zero());
    for (std::int64_t m = 1; m < path.size(); ++m) {
        const auto steps = static_cast<int>(path.length(m) / 0.1);
        for (int k = 1; k <= steps; ++k) {
            const Vec3 p = put * path.at(m, static_cast<double>(k) / steps);
            x.push_back(p.x());
            y.push_back(p.y());
            z.push_back(p.z());
        }
    }
    Trajectory points;
    points.count = static_cast<PointIndex>(x.size());
    points.axes = {view_of(x), view_of(y), view_of(z)};
    const std::vector<Eigen::Isometry3d> poses = find_poses(points, program, nullptr);
    ASSERT_GT(poses.size(), 1u);
    EXPECT_NE(find_poses(points, program, nullptr).size(), 1U);
    Diagnostics diagnostics;
    EXPECT_TRUE(note_pose(points, program, nullptr, diagnostics));
    ASSERT_EQ(diagnostics.kept().size(), 1u);
    EXPECT_NE(diagnostics.kept()[0].text.find("ambiguous"), std::string::npos);
    for (const Eigen::Isometry3d& pose : poses) {
        // Each differs from the right one by a quarter turn about the part's axis.
        const Eigen::Isometry3d left = pose * put;
        EXPECT_LT((left * Vec3::Zero()).head<2>().norm(), 0.05);
        const double quarters = std::atan2(left.linear()(1, 0), left.linear()(0, 0)) / (90 * rad_per_deg);
        EXPECT_NEAR(quarters, std::round(quarters), 1e-3);
    }
}

}  // namespace
}  // namespace clsurf::work_offset_test
