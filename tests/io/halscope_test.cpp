#include "io/formats/log_format.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace clsurf::io::halscope_test {
namespace {

Log open(const std::string& text, const LogOptions& options = {}) {
    const test::TemporaryFolder folder;
    return open_log(folder.write("scope.log", text), options);
}

const std::string table =
    "# Sampling period is 2000000 ns\n"
    "joint.0.motor-pos-cmd;joint.1.motor-pos-fb;axis.c.pos-cmd;motion.program-line;motion.current-vel;spindle.0.orient\n"
    "# Position: 0.5;0.5\n# Scale: 0;0\n"
    "+1.5;+2.5;+30;+7;+10;+1\n+1.75;+2.5;+31;+8;+10;+1\n";

TEST(Halscope, NamesChannelsAfterTheirPins) {
    const Log log = open(table);
    EXPECT_EQ(log.format, "halscope");
    EXPECT_EQ(log.records, 2);
    EXPECT_DOUBLE_EQ(log.period, 0.002);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(1), 1.75);
    EXPECT_DOUBLE_EQ(log.find("fb.y")->values.at(0), 2.5);
    EXPECT_EQ(log.find("cmd.c")->unit, "deg");
    EXPECT_DOUBLE_EQ(log.find("line")->values.at(1), 8);
    EXPECT_DOUBLE_EQ(log.find("speed")->values.at(0), 600) << "mm/s become mm/min";
    EXPECT_NE(log.find("spindle.0.orient"), nullptr) << "other pins keep their names";
    EXPECT_EQ(log.diagnostics.count("log.bad-number"), 0u);
}

TEST(Halscope, ReadsTheOldFormWithANameBeforeEachValue) {
    const Log log = open(
        "Sampling period is 1000000 nSec \n\njoint.0.motor-pos-cmd +1.5 motion.program-line +3.0 \njoint.0.motor-pos-cmd +1.6 motion.program-line +4.0 \n");
    EXPECT_EQ(log.records, 2);
    EXPECT_DOUBLE_EQ(log.period, 0.001);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(1), 1.6);
    EXPECT_DOUBLE_EQ(log.find("line")->values.at(0), 3);
}

TEST(Halscope, NumbersAxesAsLinuxcnc27Did) {
    const Log log = open(
        "Sampling period is 1000000 nSec\naxis.0.motor-pos-cmd +1.5 axis.2.motor-pos-fb -2 \naxis.0.motor-pos-cmd +2.5 axis.2.motor-pos-fb -3 \n");
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(1), 2.5);
    EXPECT_DOUBLE_EQ(log.find("fb.z")->values.at(0), -2);
}

TEST(Halscope, KeepsTheNameOfASecondPinOfAnAxis) {
    const Log log = open("# Sampling period is 1000000 ns\njoint.0.motor-pos-cmd;joint.0.pos-cmd\n1;2\n");
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(0), 1);
    EXPECT_DOUBLE_EQ(log.find("joint.0.pos-cmd")->values.at(0), 2);
}

TEST(Halscope, TakesAMapping) {
    const test::TemporaryFolder folder;
    LogOptions options;
    options.mapping =
        folder.write("m.toml", "[[column]]\nfrom = \"spindle.0.orient\"\nname = \"cmd.x\"\nunit = \"in\"\n");
    const Log log = open_log(folder.write("scope.log", table), options);
    EXPECT_EQ(log.channels.size(), 1u);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(0), 25.4);
}

TEST(Halscope, NamesTheLineOfWhatIsWrong) {
    for (const auto& [text, line] :
         {std::pair<const char*, std::uint64_t>{"# Sampling period is zero ns\na;b\n1;2\n", 1},
          {"Sampling period is 1000 ns\n\none 1 two\n", 3}}) {
        try {
            (void)open(text);
            FAIL() << text;
        } catch (const InputError& error) { EXPECT_EQ(error.diagnostic().where.number, line); }
    }
}

TEST(Halscope, ReadsOrRefusesEveryCutFile) {
    for (std::size_t size = 25; size < table.size(); ++size) {
        try {
            EXPECT_LE(open(table.substr(0, size)).records, 2);
        } catch (const InputError& error) { EXPECT_FALSE(error.diagnostic().where.file.empty()); }
    }
}

TEST(Halscope, SampleHasTheLinesThatWereRecorded) {
    const Log log = open_log(SAMPLE_LOGS "/dome_loops.halscope.csv", LogOptions{});
    EXPECT_EQ(log.records, 18531);
    EXPECT_DOUBLE_EQ(log.find("line")->values.at(8999), 863);
    EXPECT_TRUE(log.has(Role::feedback));
}

}  // namespace
}  // namespace clsurf::io::halscope_test
