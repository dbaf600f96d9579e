#include "io/formats/log_format.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace clsurf::io::twincat_csv_test {
namespace {

Log open(const std::string& text, const LogOptions& options = {}) {
    const test::TemporaryFolder folder;
    return open_log(folder.write("scope.csv", text), options);
}

std::string replaced(std::string text, char from, char to) {
    std::replace(text.begin(), text.end(), from, to);
    return text;
}

const std::string scope =
    "Name\tscope\nFile\tscope.csv\nStarttime of export\t132959733843760000\tMontag\nEndtime of export\t132959733843780000\tMontag\n\n\n"
    "Name\tcmd.x\tcmd.y\tName\tload\n"
    "SampleTime[ms]\t1\t1\tSampleTime[ms]\t2\n"
    "SymbolName\tGVL.x\tGVL.y\tSymbolName\tGVL.load\n"
    "Unit\tmm (Length)\tmm (Length)\tUnit\t(None)\n\n"
    "0\t1,5\t2\t0\t17\n"
    "1\t1,6\t2\t2\t18\n"
    "2\t1,7\t2\t\t\n"
    "EOF\n";

TEST(TwinCat, ReadsSharedTimesAndHoldsSlowerChannels) {
    for (const char separator : {'\t', ';'}) {
        const Log log = open(replaced(scope, '\t', separator));
        EXPECT_EQ(log.format, "twincat");
        EXPECT_EQ(log.records, 3);
        EXPECT_DOUBLE_EQ(log.period, 0.001);
        EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(2), 1.7);
        EXPECT_EQ(log.find("cmd.x")->unit, "mm");
        EXPECT_DOUBLE_EQ(log.find("load")->values.at(0), 17);
        EXPECT_DOUBLE_EQ(log.find("load")->values.at(1), 17);
        EXPECT_DOUBLE_EQ(log.find("load")->values.at(2), 18);
        EXPECT_EQ(log.diagnostics.count("log.held"), 1u);
        EXPECT_EQ(log.diagnostics.count("log.bad-number"), 0u);
        EXPECT_DOUBLE_EQ(log.time_of(2), 0.002);
    }
}

std::string with(const std::string& from, const std::string& to) {
    std::string text = scope;
    return text.replace(text.find(from), from.size(), to);
}

TEST(TwinCat, ADamagedTimeIsTheOnlyThingMissing) {
    // An unreadable time of the fast channels in the second record: their values are nevertheless in that row.
    Log log = open(with("\n1\t1,6", "\n1#\t1,6"));
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(0), 1.5);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(1), 1.6);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(2), 1.7);
    EXPECT_DOUBLE_EQ(log.find("load")->values.at(1), 17) << "not earlier than the record before it";
    EXPECT_DOUBLE_EQ(log.find("load")->values.at(2), 18);
    EXPECT_EQ(log.diagnostics.count("log.bad-number"), 1u);
    // An unreadable time of the slow channel: that sample is ignored, the next one counts.
    log = open(with("2\t2\t18\n2\t1,7\t2\t\t\n", "2\t2#\t18\n2\t1,7\t2\t2\t19\n"));
    EXPECT_DOUBLE_EQ(log.find("load")->values.at(0), 17);
    EXPECT_DOUBLE_EQ(log.find("load")->values.at(1), 17);
    EXPECT_DOUBLE_EQ(log.find("load")->values.at(2), 19);
}

TEST(TwinCat, CountsTheHeldChannels) {
    const auto note = [](const std::string& text) {
        const Log log = open(text);
        for (const Diagnostic& d : log.diagnostics.kept()) {
            if (d.code == "log.held") return d.text;
        }
        return std::string();
    };
    EXPECT_TRUE(note(scope).starts_with("1 channel has different times")) << note(scope);
    EXPECT_TRUE(note("Name;a\nStarttime of export;1\n\nName;cmd.x;Name;b;c\n\n0;1;0;5;6\n1;2;2;5;6\n")
                    .starts_with("2 channels have different times"));
}

TEST(TwinCat, UnderstandsDecimalPointsAndCommasAsSeparators) {
    EXPECT_DOUBLE_EQ(open(replaced(replaced(scope, ',', '.'), '\t', ',')).find("cmd.x")->values.at(1), 1.6);
    EXPECT_DOUBLE_EQ(open(replaced(scope, ',', '.')).find("cmd.x")->values.at(1), 1.6);
}

TEST(TwinCat, UnderstandsFullTimestamps) {
    const Log log =
        open("Name;a\nStarttime of export;1\n\nName;cmd.x\n\n132959733843760000;1,5\n132959733843780000;1,6\n");
    EXPECT_NEAR(log.period, 0.002, 1e-5);
    EXPECT_EQ(log.records, 2);
}

// Windows file times count 100 ns.
TEST(TwinCat, FullTimestampsOfAllColumnsCountFromTheSameMoment) {
    const Log log = open(
        "Name;a\nStarttime of export;1\n\nName;cmd.x;Name;load\n\n132959733843760000;1;132959733843780000;7\n"
        "132959733843770000;2;132959733843800000;8\n132959733843780000;3;;\n132959733843790000;4;;\n"
        "132959733843800000;5;;\n");
    const ChannelView& load = log.find("load")->values;
    EXPECT_TRUE(std::isnan(load.at(1))) << "it begins 2 ms after the first record";
    EXPECT_EQ(load.at(2), 7);
    EXPECT_EQ(load.at(3), 7);
    EXPECT_EQ(load.at(4), 8);
}

TEST(TwinCat, TakesAMappingByNameOrSymbol) {
    const test::TemporaryFolder folder;
    LogOptions options;
    options.mapping = folder.write(
        "m.toml", "[[column]]\nfrom = \"GVL.x\"\nname = \"fb.z\"\n[[column]]\nfrom = \"cmd.y\"\nname = \"fb.x\"\n");
    const Log log = open_log(folder.write("scope.csv", scope), options);
    EXPECT_DOUBLE_EQ(log.find("fb.z")->values.at(1), 1.6);
    EXPECT_DOUBLE_EQ(log.find("fb.x")->values.at(1), 2);
    EXPECT_EQ(log.find("load"), nullptr);
}

TEST(TwinCat, NamesTheLineWhereTheHeaderEnds) {
    try {
        (void)open(scope.substr(0, scope.find("0\t1,5")));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.diagnostic().where.number, 11u);
        EXPECT_NE(std::string(error.what()).find("no records follow"), std::string::npos);
    }
}

TEST(TwinCat, ReadsOrRefusesEveryCutFile) {
    for (std::size_t size = 60; size < scope.size(); ++size) {
        try {
            EXPECT_LE(open(scope.substr(0, size)).records, 3);
        } catch (const InputError& error) { EXPECT_FALSE(error.diagnostic().where.file.empty()); }
    }
}

TEST(TwinCat, SampleHasTheLinesThatWereRecorded) {
    const Log log = open_log(SAMPLE_LOGS "/dome_loops.twincat.csv", LogOptions{});
    EXPECT_EQ(log.records, 18531);
    EXPECT_NEAR(log.find("line")->values.at(8999), 863, 1) << "recorded every 4 ms";
    EXPECT_NEAR(log.find("cmd.x")->values.at(8999), 6.52835, 1e-9);
}

}  // namespace
}  // namespace clsurf::io::twincat_csv_test
