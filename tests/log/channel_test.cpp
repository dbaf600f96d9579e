#include "log/channel.h"

#include <gtest/gtest.h>

namespace clsurf::channel_test {
namespace {

/// A log of one channel with these values.
struct Made {
    std::vector<double> values;
    Log log;
    Made(const char* name, const char* unit, std::vector<double> raw, double bias = 0) : values(std::move(raw)) {
        log.name = "run";
        log.period = 0.001;
        log.records = static_cast<PointIndex>(values.size());
        log.channels.push_back({name, unit, view_of(values)});
        log.channels.back().values.bias = bias;
        normalise_units(log);
    }
    [[nodiscard]] double at(PointIndex i) const { return log.channels[0].values.at(i); }
    [[nodiscard]] const std::string& unit() const { return log.channels[0].unit; }
};

TEST(Channel, PositionsComeInMillimetresAndDegrees) {
    EXPECT_DOUBLE_EQ(Made("cmd.x", "in", {2}).at(0), 50.8);
    EXPECT_DOUBLE_EQ(Made("fb.w", "\u00b5m", {1500}).at(0), 1.5);
    EXPECT_NEAR(Made("act.c", "rad", {3.14159265358979}).at(0), 180, 1e-9);
    EXPECT_DOUBLE_EQ(Made("cmd.x", "um", {1500}, 500).at(0), 2.0);  // the bias is in the same unit
    EXPECT_EQ(Made("cmd.x", "in", {2}).unit(), "mm");
    EXPECT_EQ(Made("cmd.x", "", {2}).unit(), "mm");
    EXPECT_EQ(Made("cmd.a", "", {2}).unit(), "deg");
    EXPECT_DOUBLE_EQ(Made("speed", "m/min", {2}).at(0), 2000);
}

TEST(Channel, SaysWhatItChangedAndWhatItDidNotUnderstand) {
    EXPECT_EQ(Made("cmd.x", "in", {2}).log.diagnostics.kept().at(0).severity, Severity::note);
    const Made furlongs("cmd.x", "furlong", {2});
    EXPECT_DOUBLE_EQ(furlongs.at(0), 2);
    EXPECT_EQ(furlongs.log.diagnostics.kept().at(0).severity, Severity::warning);
    EXPECT_TRUE(Made("cmd.x", "mm", {2}).log.diagnostics.empty());
}

TEST(Channel, OtherChannelsKeepTheirUnit) {
    for (const char* name : {"load.x", "togo", "cmd.x.raw", "cmd."}) {
        const Made made(name, "in", {2});
        EXPECT_DOUBLE_EQ(made.at(0), 2) << name;
        EXPECT_EQ(made.unit(), "in") << name;
        EXPECT_TRUE(made.log.diagnostics.empty()) << name;
    }
}

TEST(Channel, TimeIsCountedInSecondsFromTheFirstRecord) {
    const Made made("time", "ms", {5000, 5002, 5004});
    EXPECT_DOUBLE_EQ(made.at(0), 0);
    EXPECT_NEAR(made.at(2), 0.004, 1e-12);
    EXPECT_EQ(made.log.diagnostics.count("log.time-origin"), 1u);
    EXPECT_NEAR(made.log.measured_period(), 0.002, 1e-12);
    EXPECT_EQ(Made("time", "s", {0, 1}).log.diagnostics.count("log.time-origin"), 0u);
}

}  // namespace
}  // namespace clsurf::channel_test
