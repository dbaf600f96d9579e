// Recorded logs, displaced by a known translation that the log does not tell.
#include "path/work_offset.h"

#include <gtest/gtest.h>

#include "io/log_format.h"
#include "io/program_file.h"

namespace clsurf {
namespace {

struct Sample {
    const char *program, *log;
};

/// The positions lie where `trajectory.offset` puts them: zero is right, −displaced is given.
const Vec3 displaced(312.5, -48.125, -101.3);

struct Displaced {
    Program program;
    Log log;
    Trajectory path;
    explicit Displaced(const Sample& sample)
        : program(io::read_program(std::string(SAMPLE_DATA "/programs/") + sample.program)),
          log(io::open_log(std::string(SAMPLE_LOGS "/") + sample.log, {})),
          path(reconstruct(log, Role::commanded, displaced)) {}
    /// Only the points from `first` on, `count` of them.
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
    const Displaced made(GetParam());
    const LineMap map(made.log.find("line")->values, made.program, made.log.keep_alive);
    const std::optional<Vec3> shift = find_shift(made.path, made.program, &map);
    ASSERT_TRUE(shift);
    EXPECT_LT((*shift + displaced).norm(), 1e-3) << (*shift + displaced).transpose();
}

TEST_P(WorkOffset, IsFoundByGeometryAlone) {
    const Displaced made(GetParam());
    const std::optional<Vec3> shift = find_shift(made.path, made.program, nullptr);
    ASSERT_TRUE(shift);
    EXPECT_LT((*shift + displaced).norm(), 2e-3) << (*shift + displaced).transpose();
}

TEST_P(WorkOffset, OfALogInPlaceIsNone) {
    Displaced made(GetParam());
    made.path.offset = Vec3::Zero();
    const std::optional<Vec3> shift = find_shift(made.path, made.program, nullptr);
    ASSERT_TRUE(shift);
    EXPECT_LT(shift->norm(), 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Recorded, WorkOffset,
                         testing::Values(Sample{"bottle_uneven.nc", "bottle_uneven.biip"},
                                         Sample{"dome_loops.nc", "dome_loops.biip"},
                                         Sample{"transition_g61.nc", "transition_g61.biip"},
                                         Sample{"petal_zigzag_g64.ngc", "petal_zigzag_g64.biip"},
                                         Sample{"petal_loops_g64.ngc", "petal_loops_g64.biip"}));

TEST(WorkOffsetRefused, ForAnotherProgram) {
    Displaced made({"petal_loops_g64.ngc", "bottle_uneven.biip"});
    EXPECT_FALSE(find_shift(made.path, made.program, nullptr));
    const LineMap map(made.log.find("line")->values, made.program, made.log.keep_alive);
    EXPECT_FALSE(find_shift(made.path, made.program, &map));
}

TEST(WorkOffsetRefused, WhereNothingDeterminesIt) {
    // Half of a log: without lines its box says nothing of where it belongs; with lines it does.
    Displaced made({"bottle_uneven.nc", "bottle_uneven.biip"});
    const LineMap map(made.log.find("line")->values, made.program, made.log.keep_alive);
    made.cut(0, made.path.count / 2);
    const std::optional<Vec3> blind = find_shift(made.path, made.program, nullptr);
    const double off = blind ? (*blind + displaced).norm() : 0.0;
    EXPECT_LT(off, 2e-3) << "a wrong offset is worse than none";
    const std::optional<Vec3> seeing = find_shift(made.path, made.program, &map);
    ASSERT_TRUE(seeing);
    EXPECT_LT((*seeing + displaced).norm(), 1e-3);
    // One straight line: nothing tells where along it.
    made = Displaced({"transition_g61.nc", "transition_g61.biip"});
    made.cut(5000, 120);
    EXPECT_FALSE(find_shift(made.path, made.program, nullptr));
}

}  // namespace
}  // namespace clsurf
