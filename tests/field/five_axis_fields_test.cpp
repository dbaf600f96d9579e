// A made five-axis run whose feedback has a planted delay and offset: both are recovered through the kinematics,
// whatever the axes do.

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "field/field_set.h"
#include "support/made_five_axis.h"

namespace clsurf::five_axis_fields_test {
namespace {

constexpr double period = 0.001;
constexpr double step = 0.03;     ///< [mm] path length per record: 30 mm/s
constexpr double lift = 0.004;    ///< [mm] offset of the tip along the commanded tool axis
constexpr double leaning = 2e-4;  ///< [rad] offset of the tilt
constexpr int late = 3;           ///< records
constexpr int count = 4000;

/// The tip goes along x while the tool swings through 60° and the table turns.
struct PlantedRun {
    test::MadeLog made;
    Kinematics kinematics = test::trunnion();
    Passes passes;
    PlantedRun() {
        const auto tip = [](int i) { return Vec3(-60 + step * i, 5, 10); };
        const auto angles = [](int i) { return RotaryAngles{0.2 + 1.0 * i / count, -0.5 + 2.0 * i / count}; };
        for (int i = 0; i < count; ++i) {
            made.add(kinematics.to_axes(tip(i), angles(i)), angles(i), 1);
            const RotaryAngles off{angles(i - late).tilt + leaning, angles(i - late).rotation};
            const Vec3 lifted = tip(i - late) + lift * Vec3::UnitZ();
            const Vec3 linear = kinematics.to_axes(lifted, off);
            for (int k = 0; k < 3; ++k) made.feedback[k].push_back(linear[k]);
            made.feedback[3].push_back(off.tilt * deg_per_rad);
            made.feedback[4].push_back(off.rotation * deg_per_rad);
        }
        made.finish(period);
        passes.push_back({0, count - 1, PassKind::cut});
    }
    Field get(const char* name, bool five = true) {
        const Trajectory path = reconstruct(made.log, Role::commanded, Vec3::Zero(),
                                            five ? std::make_shared<Kinematics>(kinematics) : nullptr);
        return FieldSet(made.log, path, passes).get(name);
    }
};

TEST(FiveAxisFields, GiveThePlantedErrorsBack) {
    PlantedRun run;
    const Field lag = run.get("following_error");
    const Field contour = run.get("contour_error");
    const Field along = run.get("following_error.x");
    const Field height = run.get("following_error.z");
    const Field orientation = run.get("orientation_error");
    const Field speed = run.get("speed");
    for (std::size_t i = 10; i < count; i += 97) {
        EXPECT_NEAR(along.values[i], -late * step, 1e-6);
        EXPECT_NEAR(height.values[i], lift, 1e-6);
        EXPECT_NEAR(lag.values[i], std::hypot(late * step, lift), 1e-6);
        EXPECT_NEAR(contour.values[i], lift, 1e-6);
        EXPECT_NEAR(speed.values[i], step / period, 1e-3);
        // Tilt is delayed by 3/4000 rad and offset by the lean; C is delayed by 6/4000 rad: on the sphere
        // √(ΔA² + sin²A ΔC²).
        const double tilt = 0.2 + static_cast<double>(i) / count;
        const double expected = std::hypot(1.0 * late / count - leaning, std::sin(tilt) * 2.0 * late / count);
        EXPECT_NEAR(orientation.values[i], expected, 2e-6) << i;
    }
    // The speed of the linear axes alone is different.
    EXPECT_GT(std::abs(run.get("speed", false).values[2000] - step / period), 1);
}

TEST(FiveAxisFields, AxisSpeedsAndToolAxis) {
    PlantedRun run;
    const Field a = run.get("speed.a");
    const Field c = run.get("speed.c");
    const Field acceleration = run.get("acceleration.c");
    const Field swing = run.get("tool_axis_speed");
    const Field x = run.get("tool_axis.x");
    const Field z = run.get("tool_axis.z");
    for (std::size_t i = 20; i < count - 20; i += 97) {
        const double part = static_cast<double>(i) / count;
        const double tilt = 0.2 + part;
        EXPECT_NEAR(a.values[i], 1.0 / (count * period), 1e-5);  // rad/s
        EXPECT_NEAR(c.values[i], 2.0 / (count * period), 1e-5);
        EXPECT_NEAR(acceleration.values[i], 0, 1e-3);
        EXPECT_NEAR(swing.values[i], std::hypot(1.0, 2.0 * std::sin(tilt)) / (count * period), 1e-4);
        EXPECT_NEAR(x.values[i], std::sin(tilt) * std::sin(-0.5 + 2 * part), 1e-6);
        EXPECT_NEAR(z.values[i], std::cos(tilt), 1e-6);
    }
    EXPECT_THROW((void)run.get("speed.b"), UsageError);
    EXPECT_THROW((void)run.get("tool_axis.x", false), UsageError);
}

}  // namespace
}  // namespace clsurf::five_axis_fields_test
