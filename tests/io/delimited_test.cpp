#include "io/formats/log_format.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/formats/text_head.h"
#include "support/temporary_folder.h"

namespace clsurf::io::delimited_test {
namespace {

Log open(const test::TemporaryFolder& folder, const std::string& text, const LogOptions& options = {}) {
    return open_log(folder.write("run.csv", text), options);
}

TEST(Delimited, ReadsOurNamesUnitsAndPeriod) {
    const test::TemporaryFolder folder;
    const Log log = open(folder, "time,cmd.x [mm],cmd.y [in],line\r\n0,1.5,1,3\r\n0.002,+2,1e0,4\r\n0.004,2.5,1,4\r\n");
    EXPECT_EQ(log.format, "delimited");
    EXPECT_EQ(log.records, 3);
    EXPECT_DOUBLE_EQ(log.period, 0.002);
    EXPECT_EQ(log.find("cmd.x")->values.at(1), 2.0);
    EXPECT_EQ(log.find("cmd.y")->unit, "mm");
    EXPECT_DOUBLE_EQ(log.find("cmd.y")->values.at(0), 25.4);
}

TEST(Delimited, TakesThePeriodFromAClockOfAnyUnitAndOrigin) {
    const test::TemporaryFolder folder;
    const Log log = open(folder, "time [ms],cmd.x [um]\n70000,1500\n70004,1600\n70008,1700\n");
    EXPECT_NEAR(log.period, 0.004, 1e-9);
    EXPECT_NEAR(log.time_of(2), 0.008, 1e-9);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(0), 1.5);
}

TEST(Delimited, TakesPositionsWithoutARoleAsCommanded) {
    const test::TemporaryFolder folder;
    const Log log = open(folder, "Time,LINE,X [in],Y,Z,fb\n0,3,1,2,3,9\n0.002,4,1,2,3,9\n");
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(0), 25.4);
    EXPECT_EQ(log.find("cmd.z")->values.at(1), 3);
    EXPECT_EQ(log.find("line")->values.at(1), 4);
    EXPECT_NE(log.find("fb"), nullptr);
    EXPECT_DOUBLE_EQ(log.period, 0.002);
    EXPECT_EQ(log.diagnostics.count("log.roles"), 1U);
    // If a role is named, plain X is not a position.
    const Log named = open(folder, "time,X,FB.X\n0,1,2\n0.002,1,2\n");
    EXPECT_NE(named.find("x"), nullptr);
    EXPECT_EQ(named.find("fb.x")->values.at(0), 2);
    EXPECT_EQ(named.find("cmd.x"), nullptr);
    EXPECT_EQ(named.diagnostics.count("log.roles"), 0U);
}

TEST(Delimited, FindsTheSeparatorOutsideQuotes) {
    const test::TemporaryFolder folder;
    const Log log = open(folder, "time,cmd.x,cmd.y,cmd.z,\"a;b\"\n0,1,2,3,4\n0.001,1,2,3,4\n");
    EXPECT_EQ(log.find("cmd.z")->values.at(1), 3);
    EXPECT_EQ(log.find("a;b")->values.at(1), 4);
}

/// The message that refuses a text.
std::string error_of(const std::string& text) {
    const test::TemporaryFolder folder;
    try {
        (void)open(folder, text);
    } catch (const InputError& error) { return error.what(); }
    return "";
}

TEST(Delimited, SaysWhatIsWrongWithItsBytes) {
    EXPECT_NE(error_of("time,cmd.x,cmd.y,cmd.z\r0,1,2,3\r0.001,1,2,3\r").find("its lines end with CR alone"),
              std::string::npos);
    const std::string damaged("time,cmd.x,cmd.y,cmd.z\n0,1,2,3\n0.001,1,\0\0,3\n0.002,1,2,3\n0.003,1,2,3\n", 68);
    EXPECT_NE(error_of(damaged).find("run.csv:3: error: a table with a control character (byte 00)"), std::string::npos)
        << error_of(damaged);
}

TEST(Delimited, CountsEveryBadNumberAndRaggedRow) {
    const test::TemporaryFolder folder;
    std::string text = "time,cmd.x,cmd.y\n";
    for (int i = 0; i < 200; ++i) {
        const std::string time = std::to_string(i);
        text += i % 4 == 1 ? time + ",bad,0\n" : i % 4 == 2 ? time + ",1,2,3\n" : time + ",1,2\n";
    }
    const Log log = open(folder, text);
    EXPECT_EQ(log.diagnostics.count("log.bad-number"), 50u);
    EXPECT_EQ(log.diagnostics.count("log.ragged-row"), 50u);
    EXPECT_EQ(log.diagnostics.kept().front().where.number, 3u);
}

TEST(Delimited, UnderstandsSemicolonsWithDecimalCommas) {
    const test::TemporaryFolder folder;
    const Log log = open(folder, "time;cmd.x\n0;1,25\n0,001;1,5\n");
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(0), 1.25);
    EXPECT_DOUBLE_EQ(log.period, 0.001);
}

TEST(Delimited, UnderstandsHeadersAsOtherToolsWriteThem) {
    const test::TemporaryFolder folder;
    // Capitals, units in parentheses; Excel's line about the separator.
    Log log = open(folder, "sep=;\nTime (ms);CMD.X (cm);Line\n0;1,5;7\n4;1,6;7\n");
    EXPECT_DOUBLE_EQ(log.period, 0.004);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(0), 15);
    EXPECT_EQ(log.find("line")->values.at(1), 7);
    // A line of units below the names.
    log = open(folder, "time,cmd.x,cmd.y,line\n[min],in,mm,-\n0,1,2,3\n0.001,2,2,3\n");
    EXPECT_EQ(log.records, 2);
    EXPECT_DOUBLE_EQ(log.period, 0.06);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(0), 25.4);
    EXPECT_TRUE(log.diagnostics.count("log.bad-number") == 0 && log.diagnostics.count("log.unit") == 2);
    // Decimal commas in quotes between separating ones.
    log = open(folder, "\"time\",\"cmd.x\"\n\"0,000\",\"1,25\"\n\"0,001\",\"1,5\"\n");
    EXPECT_DOUBLE_EQ(log.period, 0.001);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(0), 1.25);
    // A micro sign of ISO 8859-1.
    log = open(folder, "time [s];cmd.x [\xb5m]\n0;1500\n1;1600\n");
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(0), 1.5);
}

TEST(Delimited, TakesNamesFromTheCommentAboveTheRecords) {
    const test::TemporaryFolder folder;
    Log log = open(folder, "# measured by the loader\n# time cmd.x cmd.y\n0.000 1.5 2\n0.001 1.6 2\n");
    EXPECT_EQ(log.records, 2);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(1), 1.6);
    log = open(folder, "% time [ms], x [in], y, z\n0, 1, 2, 3\n2, 1, 2, 3\n");
    EXPECT_DOUBLE_EQ(log.period, 0.002);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(0), 25.4);
    // A remark above the names is not a line of names; comments may be anywhere.
    log = open(folder, "// machine 7, shift 2\ntime,cmd.x\n// begin\n0,1\n% half\n0.001,2\n");
    EXPECT_EQ(log.records, 2);
    EXPECT_TRUE(log.diagnostics.kept().empty());
    EXPECT_THROW((void)open(folder, "# machine 7, shift 2, run 3\n0,1,2\n0.001,1,2\n"), InputError);
    // Errors about columns name the line with the column names, whatever is between it and the records.
    const TextHead head = read_head("# measured\n# time cmd.x\n#\n\n0 1\n");
    EXPECT_EQ(head.line, 2U);
    EXPECT_EQ(head.first_data_line, 5U);
}

TEST(Delimited, ReadsTimesOfDay) {
    const test::TemporaryFolder folder;
    // Differences are exact to the last written digit: the date costs no precision.
    Log log = open(
        folder,
        "time,cmd.x\n2024-05-01T12:00:00.000125Z,1\n2024-05-01T12:00:00.001125Z,2\n2024-05-01T12:00:00.002125Z,3\n");
    EXPECT_NEAR(log.period, 0.001, 1e-10);
    EXPECT_NEAR(log.time_of(2), 0.002, 1e-10);
    EXPECT_EQ(log.diagnostics.count("log.bad-number"), 0U);
    // Over midnight, with a date and without; offsets; decimal commas.
    log = open(
        folder,
        "Time [hh:mm:ss];cmd.x\n31.12.2024 23:59:59,998;1\n01.01.2025 00:00:00,000;2\n01.01.2025 00:00:00,002;2\n");
    EXPECT_NEAR(log.time_of(2), 0.004, 1e-9);
    log = open(folder, "time,cmd.x\n23:59:59.998,1\n0:00:00.000,2\n0:00:00.002,2\n");
    EXPECT_NEAR(log.time_of(2), 0.004, 1e-9);
    log = open(folder, "time,cmd.x\n2024/05/01 12:00:00.000 +02:00,1\n2024/05/01 10:00:00.004Z,2\n");
    EXPECT_NEAR(log.period, 0.004, 1e-9);
    EXPECT_EQ(log.diagnostics.count("log.unit"), 0U);
    // Fields that are not times are missing values, with their place.
    log = open(folder, "time,cmd.x\n12:00:00.000,1\n12:61:00.001,2\n12:00:00.002,3\n12:00:00.003,3\n");
    EXPECT_EQ(log.diagnostics.count("log.bad-number"), 1U);
    EXPECT_TRUE(std::isnan(log.time_of(1)));
}

TEST(Delimited, PassesOverColumnsOfWords) {
    const test::TemporaryFolder folder;
    const Log log =
        open(folder, "Date;time;Mode;cmd.x\n01.05.2024;12:00:00,000;AUTO;1\n01.05.2024;12:00:00,002;AUTO;2\n");
    EXPECT_NEAR(log.period, 0.002, 1e-9);
    EXPECT_EQ(log.find("Mode"), nullptr);
    EXPECT_EQ(log.find("Date"), nullptr);
    EXPECT_EQ(log.diagnostics.count("log.words"), 1U);
    EXPECT_EQ(log.diagnostics.count("log.bad-number"), 0U);
    // A column of positions may begin with missing values.
    EXPECT_EQ(open(folder, "time,cmd.x\n0,-\n0.001,2\n").find("cmd.x")->values.at(1), 2);
}

TEST(Delimited, JoinsEventsAndRecordsByTheirClocks) {
    const test::TemporaryFolder folder;
    folder.write("events.csv", "when,block\n2024-05-01 23:59:59.999,5\n2024-05-02 00:00:00.001,6\n");
    LogOptions options;
    options.mapping =
        folder.write("m.toml",
                     "[[column]]\nfrom = \"t\"\nname = \"time\"\n[[column]]\nfrom = \"x\"\nname = \"cmd.x\"\n"
                     "[events]\nfile = \"events.csv\"\nfrom = \"when\"\nline = \"block\"\n");
    const Log log =
        open(folder, "t,x\n2024-05-02T00:00:00.000,1\n2024-05-02T00:00:00.001,2\n2024-05-02T00:00:00.002,3\n", options);
    EXPECT_EQ(log.find("line")->values.at(0), 5);
    EXPECT_EQ(log.find("line")->values.at(1), 6);
    options.mapping = folder.write("scaled.toml", "[[column]]\nfrom = \"t\"\nname = \"time\"\nscale = 0.001\n");
    EXPECT_THROW((void)open(folder, "t,x\n12:00:00,1\n12:00:01,2\n", options), InputError);
}

TEST(Delimited, SaysThatATextIsUtf16) {
    const test::TemporaryFolder folder;
    try {
        (void)open(folder, std::string("\xff\xfet\0i\0", 6));
        FAIL();
    } catch (const InputError& error) { EXPECT_NE(std::string(error.what()).find("UTF-16"), std::string::npos); }
}

TEST(Delimited, TakesABadNumberAsMissingAndNamesItsPlace) {
    const test::TemporaryFolder folder;
    const Log log = open(folder, "time,cmd.x\n0,1\n0.001,oops\n0.002\n");
    EXPECT_TRUE(std::isnan(log.find("cmd.x")->values.at(1)));
    EXPECT_TRUE(std::isnan(log.find("cmd.x")->values.at(2)));
    ASSERT_EQ(log.diagnostics.count("log.bad-number"), 1u);
    EXPECT_EQ(log.diagnostics.kept()[0].where.number, 3u);
    EXPECT_EQ(log.diagnostics.kept()[0].where.column, 7u);
    EXPECT_EQ(log.diagnostics.count("log.ragged-row"), 1u);
}

TEST(Delimited, LeavesOutALastLineThatWasCut) {
    const test::TemporaryFolder folder;
    const Log log = open(folder, "time,cmd.x,line\n0,1,5\n0.001,2,5\n0.00");
    EXPECT_EQ(log.records, 2);
    ASSERT_EQ(log.diagnostics.kept().size(), 1u);
    EXPECT_EQ(log.diagnostics.kept()[0].code, "log.incomplete");
    EXPECT_EQ(log.diagnostics.kept()[0].where.number, 4u);
    // Complete, although without a line end.
    EXPECT_EQ(open(folder, "time,cmd.x\n0,1\n0.001,2").records, 2);
}

TEST(Delimited, RefusesRowsWithMoreFieldsThanTheHeader) {
    const test::TemporaryFolder folder;
    try {
        (void)open(folder, "time,cmd.x\n0,000,1,5\n0,001,2,5\n");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("a row has 4 fields, the header 2"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("the separator cannot be a comma"), std::string::npos) << error.what();
    }
    // A separator at the end of each line is not a field; at the end of one row only it is a warning.
    EXPECT_EQ(open(folder, "time,cmd.x\n0,1,\n0.001,2,\n").records, 2);
    EXPECT_EQ(open(folder, "time,cmd.x\n0,1\n0.001,2,7\n0.002,3\n").diagnostics.count("log.ragged-row"), 1u);
}

TEST(Delimited, NeedsAPeriodFromSomewhere) {
    const test::TemporaryFolder folder;
    EXPECT_THROW((void)open(folder, "cmd.x\n1\n2\n"), InputError);
    LogOptions options;
    options.period = 0.004;
    EXPECT_DOUBLE_EQ(open(folder, "cmd.x\n1\n2\n", options).period, 0.004);
}

TEST(Delimited, FollowsAMapping) {
    const test::TemporaryFolder folder;
    LogOptions options;
    options.mapping = folder.write(
        "m.toml",
        "[log]\nperiod_s = 0.002\n[[column]]\nfrom = \"DES_POS|1\"\nname = \"cmd.x\"\nunit = \"mm\"\nscale = 0.001\n");
    const Log log = open(folder, "n,DES_POS|1\n0,1500\n1,1600\n", options);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(0), 1.5);
    EXPECT_EQ(log.channels.size(), 1u);
}

TEST(Delimited, RefusesAMappingWithAnUnknownKeyOrColumn) {
    const test::TemporaryFolder folder;
    LogOptions options;
    options.mapping = folder.write("m.toml", "[[column]]\nfrom = \"b\"\nname = \"cmd.x\"\nunits = \"mm\"\n");
    try {
        (void)open(folder, "a,b\n1,2\n", options);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.diagnostic().where.number, 4u);
        EXPECT_EQ(error.diagnostic().hint, "did you mean 'unit'?");
    }
    options.mapping = folder.write("m.toml", "[log]\nperiod_s=1\n[[column]]\nfrom = \"missing\"\nname = \"cmd.x\"\n");
    EXPECT_THROW((void)open(folder, "a,b\n1,2\n", options), InputError);
}

TEST(Delimited, ReadsRecordedHalsamplerText) {
    LogOptions options;
    options.mapping = SAMPLE_DATA "/logs/dome_loops.mapping.toml";
    const Log text = open_log(SAMPLE_LOGS "/dome_loops.halsampler.txt", options);
    const Log biip = open_log(SAMPLE_LOGS "/dome_loops.biip", {});
    EXPECT_EQ(text.format, "halsampler");
    ASSERT_EQ(text.records, biip.records);
    for (PointIndex i = 0; i < text.records; i += 997) {
        EXPECT_NEAR(text.find("cmd.x")->values.at(i), biip.find("cmd.x")->values.at(i), 1e-6);
        EXPECT_EQ(text.find("line")->values.at(i), biip.find("line")->values.at(i));
    }
    EXPECT_THROW((void)open_log(SAMPLE_LOGS "/dome_loops.halsampler.txt", {}), InputError);
}

TEST(Delimited, TakesLinesFromEventsInASecondFile) {
    const test::TemporaryFolder folder;
    (void)folder.write("events.csv", "Line;T\n8;0,004\n7;0,001\n9;99\n");
    LogOptions options;
    options.mapping = folder.write(
        "m.toml",
        "[log]\nperiod_s = 0.001\n[events]\nfile = \"events.csv\"\nfrom = \"T\"\nline = \"Line\"\n[[column]]\nfrom = \"P\"\nname = \"cmd.x\"\n");
    const Log log = open(folder, "P;Q\n1;1\n2;1\n3;1\n4;1\n5;1\n6;1\n", options);
    const double lines[] = {0, 7, 7, 7, 8, 8};
    for (PointIndex i = 0; i < 6; ++i) EXPECT_EQ(log.find("line")->values.at(i), lines[i]) << i;
    EXPECT_EQ(log.diagnostics.count("log.events-outside"), 1u);
}

TEST(Delimited, CountsRecordsWhereTheEventsDo) {
    const test::TemporaryFolder folder;
    (void)folder.write("events.csv", "n,line\n0,3\n2,4\n");
    LogOptions options;
    options.period = 0.002;
    options.mapping = folder.write(
        "m.toml",
        "[events]\nfile = \"events.csv\"\nat = \"record\"\nfrom = 0\nline = 1\n[[column]]\nfrom = 0\nname = \"cmd.x\"\n");
    const Log log = open(folder, "P,Q\n1,1\n2,1\n3,1\n", options);
    EXPECT_EQ(log.find("line")->values.at(1), 3);
    EXPECT_EQ(log.find("line")->values.at(2), 4);
}

TEST(Delimited, NamesTheEventFileThatIsWrong) {
    const test::TemporaryFolder folder;
    (void)folder.write("empty.csv", "");
    (void)folder.write("other.csv", "a,b\n1,2\n");
    for (const std::string name : {"missing.csv", "empty.csv", "other.csv", "/dev/full"}) {
        LogOptions options;
        options.period = 0.002;
        options.mapping =
            folder.write("m.toml", "[events]\nfile = \"" + name +
                                       "\"\nfrom = \"T\"\nline = \"Line\"\n[[column]]\nfrom = 0\nname = \"cmd.x\"\n");
        try {
            (void)open(folder, "P,Q\n1,1\n2,1\n", options);
            FAIL() << name;
        } catch (const InputError& error) { EXPECT_NE(error.diagnostic().where.file.find(name), std::string::npos); }
    }
}

TEST(Delimited, MemoryDoesNotGrowWithAHeaderAboveEmptyRows) {
    const test::TemporaryFolder folder;
    std::string text = "cmd.x";
    for (int i = 0; i < 4'000; ++i) text += ",a" + std::to_string(i);
    for (int i = 0; i < 50'000; ++i) text += "\n1";
    EXPECT_THROW((void)open(folder, text), InputError);
    EXPECT_THROW((void)open(folder, "cmd.x" + std::string(5'000, ',') + "\n1\n"), InputError);
}

TEST(Delimited, SampleWithEventsHasTheLinesThatWereRecorded) {
    LogOptions options;
    options.mapping = SAMPLE_DATA "/logs/dome_loops.events.mapping.toml";
    const Log log = open_log(SAMPLE_LOGS "/dome_loops.signals.csv", options);
    EXPECT_EQ(log.records, 18531);
    EXPECT_EQ(log.find("line")->values.at(8999), 863);
    EXPECT_EQ(log.diagnostics.count("log.events-outside"), 0u);
}

}  // namespace
}  // namespace clsurf::io::delimited_test
