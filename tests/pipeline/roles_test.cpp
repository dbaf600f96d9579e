// Which positions of a log are used for which purpose.

#include "pipeline/roles.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace clsurf::roles_test {
namespace {

constexpr double zeros[3]{};

/// A log with these channels, all zero.
Log log_with(const std::vector<std::string>& channels) {
    Log log;
    log.records = 3;
    log.period = 0.001;
    for (const std::string& name : channels) { log.channels.push_back({name, "mm", view_of(zeros)}); }
    return log;
}

const std::vector<std::string> commanded{"cmd.x", "cmd.y", "cmd.z"};

std::vector<std::string> with(std::vector<std::string> channels, const std::string& role, const std::string& axes) {
    for (const char axis : axes) channels.push_back(role + "." + axis);
    return channels;
}

TEST(Roles, ShowCommandedPositionsUnlessTheLogLacksThem) {
    EXPECT_EQ(shown_role(log_with(with(commanded, "fb", "xyz"))), Role::commanded);
    EXPECT_EQ(shown_role(log_with(with(with({}, "fb", "xyz"), "act", "xyz"))), Role::feedback);
    EXPECT_EQ(shown_role(log_with(with({}, "act", "xyz"))), Role::actual);
    EXPECT_EQ(shown_role(log_with(commanded), Role::feedback), Role::feedback);
}

TEST(Roles, MeasureHeightsFromTheMostTruthfulPositions) {
    const Log both = log_with(with(with(commanded, "fb", "xyz"), "act", "xyz"));
    const Trajectory path = reconstruct(both, Role::commanded, Vec3::Zero());
    EXPECT_EQ(measured_role(both, path), Role::actual);
    EXPECT_EQ(measured_role(both, path, Role::feedback), Role::feedback);
    EXPECT_EQ(measured_role(both, path, Role::commanded), std::nullopt);
    const Log one = log_with(with(commanded, "fb", "xyz"));
    EXPECT_EQ(measured_role(one, reconstruct(one, Role::commanded, Vec3::Zero())), Role::feedback);
    EXPECT_EQ(measured_role(one, reconstruct(one, Role::feedback, Vec3::Zero())), std::nullopt);
}

// Linear scales without encoders at the rotary axes do not determine the tip.
TEST(Roles, LeaveOutPositionsThatLackTheRotaryAxesOfTheMachine) {
    auto kinematics = std::make_shared<Kinematics>();
    kinematics->type = KinematicsType::table_table;
    const std::string axes{'x', 'y', 'z', kinematics->tilt.letter, kinematics->rotation.letter};
    const Log log = log_with(with(with(with({}, "cmd", axes), "fb", axes), "act", "xyz"));
    const Trajectory path = reconstruct(log, Role::commanded, Vec3::Zero(), kinematics);
    EXPECT_EQ(measured_role(log, path), Role::feedback);
}

TEST(Roles, CompareTwoLogsByWhatBothHave) {
    const Log a = log_with(with(commanded, "act", "xyz"));
    const Log b = log_with(with(with({}, "fb", "xyz"), "act", "xyz"));
    EXPECT_EQ(common_role(a, b), Role::actual);
    EXPECT_EQ(common_measured_role(a, b), Role::actual);
    EXPECT_EQ(common_role(log_with(commanded), log_with(with({}, "fb", "xyz"))), std::nullopt);
    EXPECT_EQ(common_measured_role(log_with(commanded), b), std::nullopt);
}

}  // namespace
}  // namespace clsurf::roles_test
