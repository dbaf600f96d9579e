// The effect of rounded rotary axes on the tip: it moves by the step times its distance from the axis.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "limits/judge_limits.h"
#include "program/interpreter.h"
#include "support/made_columns.h"

namespace clsurf::tip_rounding_test {
namespace {

constexpr double period = 0.001;

/// A trunnion. The tip is 60 to 100 mm from the axis of C, and 80 mm above that of A.
std::shared_ptr<const Kinematics> trunnion() {
    Kinematics kinematics;
    kinematics.type = KinematicsType::table_table;
    kinematics.centre_from_tilt = Vec3(0, 0, 80);
    return std::make_shared<const Kinematics>(kinematics);
}

/// The tip at these places of a straight line, while both rotary axes turn at constant speed. Angles are rounded to `step`
/// [deg].
Log turning_log(const std::vector<double>& places, double step) {
    const std::shared_ptr<const Kinematics> kinematics = trunnion();
    test::NamedColumns columns{{"cmd.x", {}}, {"cmd.y", {}}, {"cmd.z", {}}, {"cmd.a", {}}, {"cmd.c", {}}};
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto time = period * static_cast<double>(i);
        const double a = -20 - 7.123 * time, c = 10 + 41.57 * time;
        const Vec3 linear = kinematics->to_axes({60 + places[i], 0, 0}, {a * rad_per_deg, c * rad_per_deg});
        for (std::size_t axis = 0; axis < 3; ++axis)
            columns[axis].second.push_back(linear[static_cast<Eigen::Index>(axis)]);
        columns[3].second.push_back(std::round(a / step) * step);
        columns[4].second.push_back(std::round(c / step) * step);
    }
    return test::log_of_columns(period, std::move(columns));
}

LimitReport judged(const Log& log) {
    auto text = std::make_shared<std::string>("M30\n");
    const Program program = parse_program(SourceText("part.nc", *text, text), {});
    const Trajectory path = reconstruct(log, Role::commanded, Vec3(Vec3::Zero()), trunnion());
    const auto n = static_cast<std::size_t>(log.records);
    const LineMap lines(Column<std::uint32_t>(n, LineMap::no_motion), Column<std::uint8_t>(n, std::uint8_t{0}),
                        program);
    const std::vector<StatedLimit> limits{{LimitedQuantity::path_speed, 0, 25},
                                          {LimitedQuantity::tangential_acceleration, 0, 2000},
                                          {LimitedQuantity::normal_acceleration, 0, 2000},
                                          {LimitedQuantity::path_jerk, 0, 50000}};
    return judge_limits(LimitedRun{log, path, program, lines}, limits);
}

TEST(TipRounding, RoundedAnglesAloneExceedNoLimit) {
    std::vector<double> places;
    for (int i = 0; i < 2000; ++i) places.push_back(0.02 * i);
    for (const double step : {1e-4, 1e-3, 1e-2}) {
        const LimitReport report = judged(turning_log(places, step));
        EXPECT_EQ(report.judged.size(), 4u);
        EXPECT_TRUE(report.findings.empty()) << step << " deg: " << report.greatest_factor();
    }
}

TEST(TipRounding, WhatExceedsALimitIsFoundAllTheSame) {
    // 100 records at 1.3 times the acceleration. A step of 0.001 deg moves the tip by some 3 µm: over 16 records
    // its acceleration is uncertain by 23 mm/s².
    std::vector<double> places{0};
    double speed = 0;
    for (int i = 0; i < 1000; ++i) {
        if (i >= 450 && i < 550) speed += (i < 500 ? 2600 : -2600) * period;
        places.push_back(places.back() + speed * period);
    }
    for (const double step : {1e-4, 1e-3}) {
        const LimitReport report = judged(turning_log(places, step));
        ASSERT_FALSE(report.findings.empty()) << step << " deg";
        const auto found =
            std::find_if(report.findings.begin(), report.findings.end(), [](const LimitFinding& finding) {
                return finding.limit.quantity == LimitedQuantity::tangential_acceleration;
            });
        ASSERT_NE(found, report.findings.end()) << step << " deg";
        EXPECT_NEAR(found->factor, 1.3, 0.02) << step << " deg";
        EXPECT_GE(found->uncertainty, std::abs(found->factor - 1.3));
    }
}

}  // namespace
}  // namespace clsurf::tip_rounding_test
