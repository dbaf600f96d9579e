#include "io/formats/joined_log.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/formats/biip.h"
#include "io/formats/log_format.h"
#include "support/temporary_folder.h"

namespace clsurf::io::joined_log_test {
namespace {

/// A log with the times 0, 1, 2 … n − 1 times `period` and a channel that counts from `first`.
Log made_log(const test::TemporaryFolder& folder, const std::string& name, const std::string& channel, int records,
             double period, double first, const std::string& metadata) {
    const std::string path = folder / name;
    BiipWriter writer(path, {{"time", "s"}, {channel, "%"}}, period, metadata);
    for (int i = 0; i < records; ++i) {
        const std::array<double, 2> record{i * period, first + i};
        writer.append(std::as_bytes(std::span(record)));
    }
    writer.close();
    return open_log(path, {});
}

class JoinedLog : public ::testing::Test {
protected:
    test::TemporaryFolder folder_;
    Log log_ = made_log(folder_, "run.biip", "speed", 100, 0.01, 0, R"({"recorded":"2026-11-25T00:00:00.250+01:00"})");
    Log slow_ =
        made_log(folder_, "slow.biip", "spindle.load", 20, 0.1, 50, R"({"recorded":"2026-11-24T22:59:59.800Z"})");

    [[nodiscard]] double load(PointIndex record) const { return log_.find("spindle.load")->values.at(record); }
};

// The log begins 0.45 s after the slow one, between its records 4 and 5.
TEST_F(JoinedLog, BelongsTogetherByTheTimesOfBoth) {
    EXPECT_TRUE(join_log(log_, slow_, {}).empty());
    EXPECT_EQ(log_.find("spindle.load")->unit, "%");
    EXPECT_EQ(load(0), 54);
    EXPECT_EQ(load(4), 54);
    EXPECT_EQ(load(6), 55);
    EXPECT_EQ(load(99), 64);
    EXPECT_EQ(log_.find("speed")->values.at(99), 99);
}

TEST_F(JoinedLog, IsKeptAliveWithoutTheOther) {
    (void)join_log(log_, slow_, {});
    slow_ = Log{};
    EXPECT_EQ(load(0), 54);
}

TEST_F(JoinedLog, BelongsTogetherByAnOffset) {
    const Diagnostics found = join_log(log_, slow_, {1.75, {}});
    EXPECT_EQ(load(0), 67);
    EXPECT_EQ(load(20), 69);
    EXPECT_EQ(load(44), 69);  // 0.29 s after the last record
    EXPECT_TRUE(std::isnan(load(46)));
    ASSERT_EQ(found.kept().size(), 1u);
    EXPECT_EQ(found.kept()[0].code, "join.gap");
    EXPECT_NE(found.kept()[0].text.find("has no value within 0.3 s before 5"), std::string::npos)
        << found.kept()[0].text;
}

TEST_F(JoinedLog, HoldsAValueAsLongAsItIsTold) {
    (void)join_log(log_, slow_, {1.75, 0.5});
    EXPECT_EQ(load(60), 69);
    EXPECT_TRUE(std::isnan(load(70)));
}

TEST_F(JoinedLog, RefusesWhatDoesNotBelongTogether) {
    EXPECT_THROW((void)join_log(log_, slow_, {30.0, {}}), InputError);
    EXPECT_THROW((void)join_log(log_, log_, {0.0, {}}), InputError);  // both have `speed`
    for (const char* metadata :
         {"", "{}", R"({"recorded":7})", R"({"recorded":"in the morning"})", R"({"recorded":"07:30:00"})"}) {
        const Log undated = made_log(folder_, "undated.biip", "load.x", 20, 0.1, 50, metadata);
        EXPECT_THROW((void)join_log(log_, undated, {}), UsageError) << metadata;
    }
}

}  // namespace
}  // namespace clsurf::io::joined_log_test
