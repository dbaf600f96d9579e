#include "log/health.h"

#include <vector>

#include <gtest/gtest.h>

namespace clsurf {
namespace {

/// A log over vectors: x rises by 0.05 mm a record, y and z stand.
struct Made {
    std::vector<double> x, y, z, time;
    Log log() {
        Log log;
        log.name = "run";
        log.period = 0.001;
        log.records = static_cast<PointIndex>(x.size());
        for (const auto& [name, column] : {std::pair{"cmd.x", &x}, std::pair{"cmd.y", &y}, std::pair{"cmd.z", &z}, std::pair{"time", &time}}) {
            log.channels.push_back({name, "mm", {reinterpret_cast<const std::byte*>(column->data()), 8, log.records, ScalarType::f64, false, 1, 0}});
        }
        return log;
    }
    Made() {
        for (int i = 0; i < 2000; ++i) {
            x.push_back(0.05 * i);
            y.push_back(0);
            z.push_back(0);
            time.push_back(0.001 * i);
        }
    }
};

TEST(Health, SaysNothingOfAGoodLogButWhatIsMissing) {
    Made made;
    const Diagnostics found = check_health(made.log(), 0);
    EXPECT_EQ(found.count("log.jump"), 0u);
    EXPECT_EQ(found.count("log.time-gap"), 0u);
    EXPECT_EQ(found.count("log.missing-channel"), 2u);  // feedback, line
}

TEST(Health, FindsAGapInTimeWithItsPlace) {
    Made made;
    for (std::size_t i = 1000; i < 2000; ++i) made.time[i] += 0.005;
    const Diagnostics found = check_health(made.log(), 0);
    ASSERT_EQ(found.count("log.time-gap"), 1u);
    for (const Diagnostic& d : found.kept()) {
        if (d.code != "log.time-gap") continue;
        EXPECT_EQ(d.where.number, 1000u);
    }
}

TEST(Health, FindsAJumpAndAMissingValue) {
    Made made;
    for (std::size_t i = 500; i < 2000; ++i) made.y[i] = 30;
    made.z[77] = std::numeric_limits<double>::quiet_NaN();
    const Diagnostics found = check_health(made.log(), 0);
    EXPECT_EQ(found.count("log.jump"), 1u);
    EXPECT_EQ(found.count("log.missing-value"), 1u);
}

}  // namespace
}  // namespace clsurf
