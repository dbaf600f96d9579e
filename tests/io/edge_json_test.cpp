#include "io/formats/log_format.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace clsurf::io::edge_json_test {
namespace {

Log open(const std::string& text, const LogOptions& options = {}) {
    const test::TemporaryFolder folder;
    return open_log(folder.write("run.json", text), options);
}

const std::string header =
    "{\"Header\":{\"CycleTimeMs\":2,\"SignalListHFData\":[{\"Name\":\"CYCLE\",\"Axis\":\"Cycle\"},\n"
    "{\"Name\":\"DES_POS|1\",\"Axis\":\"X1\"},{\"Name\":\"ENC_POS|5\",\"Axis\":\"B1\"},{\"Name\":\"LOAD|6\",\"Axis\":\"SP1\"}]},\n";
const std::string recording =
    header +
    "\"Payload\":[{\"HFBlockEvent\":{\"HFProbeCounter\":100,\"SeekOffset\":5}},\n"
    "{\"HFData\":[[100,1.5,90,7],[101,1.6,90,7]]},\n"
    "{\"HFCallEvent\":{\"HFProbeCounter\":102,\"SeekOffset\":20,\"CallStackLevel\":1,\"Path\":\"/_PART\"}},\n"
    "{\"HFCallEvent\":{\"HFProbeCounter\":103,\"SeekOffset\":3,\"CallStackLevel\":2,\"Path\":\"/_SUB\"}},\n"
    "{\"HFBlockEvent\":{\"HFProbeCounter\":103,\"SeekOffset\":4}},\n"
    "{\"HFData\":[[102,1.7,90,7],[103,1.8,null,7]]},\n"
    "{\"HFCallEvent\":{\"HFProbeCounter\":106,\"SeekOffset\":21,\"CallStackLevel\":1,\"Path\":\"/_PART\"}},\n"
    "{\"HFBlockEvent\":{\"HFProbeCounter\":900,\"SeekOffset\":22}},\n"
    "{\"HFData\":[[106,1.9,90,7]]}],\"Footer\":null}\n";

TEST(Edge, NamesSignalsAfterTheirAxes) {
    const Log log = open(recording);
    EXPECT_EQ(log.format, "edge");
    EXPECT_EQ(log.records, 5);
    EXPECT_DOUBLE_EQ(log.period, 0.002);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(3), 1.8);
    EXPECT_EQ(log.find("fb.b")->unit, "deg");
    EXPECT_NE(log.find("LOAD|6"), nullptr) << "a spindle has no axis letter";
    EXPECT_DOUBLE_EQ(log.time_of(4), 0.012) << "a gap in the counter is a gap in time";
}

TEST(Edge, ALineIsThatOfTheInnermostProgram) {
    const Log log = open(recording);
    ASSERT_EQ(log.programs.size(), 3u);
    EXPECT_EQ(log.programs[0].name, "(not recorded)") << "the recording begins inside a program";
    EXPECT_EQ(log.programs[1].name, "/_PART");
    EXPECT_EQ(log.programs[2].name, "/_SUB");
    const double lines[] = {5, 5, 20, 4, 21};
    const double programs[] = {0, 0, 1, 2, 1};
    for (PointIndex i = 0; i < 5; ++i) {
        EXPECT_EQ(log.find("line")->values.at(i), lines[i]) << i;
        EXPECT_EQ(log.find("program")->values.at(i), programs[i]) << i;
    }
    EXPECT_EQ(log.diagnostics.count("log.events-outside"), 1u);
}

TEST(Edge, ReadsACutRecordingAsFarAsItGoes) {
    const Log log = open(recording.substr(0, recording.find("[103,1.8") + 4));
    EXPECT_EQ(log.records, 3);
    EXPECT_FALSE(log.closed);
    EXPECT_EQ(log.diagnostics.count("log.unclosed"), 1u);
    for (std::size_t size = header.size(); size < recording.size(); ++size) {
        try {
            EXPECT_LE(open(recording.substr(0, size)).records, 5);
        } catch (const InputError& error) { EXPECT_FALSE(error.diagnostic().where.file.empty()); }
    }
}

TEST(Edge, NamesLineAndColumnOfWhatIsNoJson) {
    std::string damaged = recording;
    damaged[recording.find("[101,1.6") + 4] = 'x';
    try {
        (void)open(damaged);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.diagnostic().where.number, 4u);
        EXPECT_NE(std::string(error.what()).find("is not valid JSON"), std::string::npos);
    }
}

TEST(Edge, LeavesOutRowsThatLackValues) {
    const Log log = open(header + "\"Payload\":[{\"HFData\":[[1,2],[2,1,1,1]]}]}");
    EXPECT_EQ(log.records, 1);
    EXPECT_EQ(log.diagnostics.count("log.ragged-row"), 1u);
}

TEST(Edge, CountsTimeFromTheFirstKnownCycle) {
    const Log log = open(header + "\"Payload\":[{\"HFData\":[[null,1,1,1],[101,1,1,1],[103,1,1,1]]}]}");
    EXPECT_TRUE(std::isnan(log.find("time")->values.at(0)));
    EXPECT_DOUBLE_EQ(log.find("time")->values.at(1), 0);
    EXPECT_DOUBLE_EQ(log.find("time")->values.at(2), 0.004);
}

/// A recording of Z1, with one position per cycle.
Log open_z(const std::vector<std::pair<int, double>>& rows, const LogOptions& options = {}) {
    std::string text =
        "{\"Header\":{\"CycleTimeMs\":2,\"SignalListHFData\":[{\"Name\":\"CYCLE\",\"Axis\":\"Cycle\"},"
        "{\"Name\":\"DES_POS|3\",\"Axis\":\"Z1\"},{\"Name\":\"LOAD|3\",\"Axis\":\"Z1\"}]},\"Payload\":[{\"HFData\":[";
    for (const auto& [cycle, position] : rows) text += fmt::format("[{},{},7],", cycle, position);
    text.back() = ']';
    return open(text + "}]}", options);
}

TEST(Edge, AnAxisThatGoesOnAtTheEndOfATurnIsNoLength) {
    for (const double sign : {1.0, -1.0}) {
        const Log log = open_z({{1, sign * 343}, {2, sign * 351.5}, {3, sign * 0.1}, {4, sign * 8.8}, {5, sign * 17}});
        EXPECT_EQ(log.find("cmd.z"), nullptr);
        EXPECT_EQ(log.find("load.z"), nullptr);
        EXPECT_EQ(log.find("DES_POS|3")->unit, "deg");
        EXPECT_EQ(log.find("LOAD|3")->unit, "%");
    }
    // At rest next to the end of a turn.
    EXPECT_EQ(open_z({{1, 0.001}, {2, 0}, {3, 359.999}, {4, 0}, {5, 0.001}}).find("cmd.z"), nullptr);
    // A length: a jump of another size, a wrong record, a gap in the cycles, a rapid motion within 0 … 360.
    for (const std::vector<std::pair<int, double>>& rows :
         {std::vector<std::pair<int, double>>{{1, 343}, {2, 351.5}, {3, 2}, {4, 10.5}, {5, 19}},
          {{1, 343}, {2, 343}, {3, 0}, {4, 343}, {5, 343}},
          {{1, 343}, {2, 351.5}, {40, 0}, {41, 8.5}, {42, 17}},
          {{1, 0}, {2, 120}, {3, 240}, {4, 360}, {5, 360}}}) {
        const Log log = open_z(rows);
        ASSERT_NE(log.find("cmd.z"), nullptr);
        EXPECT_EQ(log.find("cmd.z")->unit, "mm");
        EXPECT_EQ(log.diagnostics.count("log.rotary-axis"), 0u);
    }
}

TEST(Edge, RefusesWhatIsNoRecording) {
    EXPECT_THROW((void)open("{\"SignalListHFData\":[]}"), InputError);
    EXPECT_THROW((void)open("{\"Payload\":[{\"HFData\":[[1,2]]}]}"), InputError);
    EXPECT_THROW((void)open("{\"HFData\":" + std::string(100, '[')), InputError);
    // A signal behind the first rows would have fewer values than the others.
    EXPECT_THROW(
        (void)open(header + "\"Payload\":[{\"HFData\":[[1,2,3,4]]}],\"SignalListHFData\":[{\"Name\":\"CYCLE\"}]}"),
        InputError);
    EXPECT_THROW((void)open("{\"Header\":{\"SignalListHFData\":[{\"Name\":\"a\"}]},\"Payload\":[{\"HFData\":[[1]]}]}"),
                 InputError);
}

TEST(Edge, SampleHasItsGapsAndPrograms) {
    const Log log = open_log(SAMPLE_LOGS "/edge_300.json", LogOptions{});
    EXPECT_EQ(log.records, 300);
    // Z1 is a spindle: at 700 1/min its position goes from one end of a turn to the other once in these 0.6 s.
    EXPECT_EQ(log.find("cmd.z"), nullptr);
    EXPECT_EQ(log.find("fb.z"), nullptr);
    EXPECT_EQ(log.find("load.z"), nullptr);
    EXPECT_EQ(log.find("DES_POS|3")->unit, "deg");
    EXPECT_EQ(log.find("ENC_POS|3")->unit, "deg");
    EXPECT_EQ(log.find("cmd.x")->unit, "mm");
    EXPECT_EQ(log.diagnostics.count("log.rotary-axis"), 1u);
    EXPECT_DOUBLE_EQ(log.period, 0.002);
    ASSERT_EQ(log.programs.size(), 3u);
    EXPECT_EQ(log.programs[1].name, "/_CUTTING");
    EXPECT_EQ(log.programs[2].name, "/_CYCLES_DIR/_CYCLE714");
    EXPECT_EQ(log.find("line")->values.at(299), 431);
    EXPECT_EQ(log.find("program")->values.at(299), 1);
    EXPECT_EQ(log.find("line")->values.at(100), 22) << "inside the cycle";
    EXPECT_EQ(log.find("program")->values.at(100), 2);
}

}  // namespace
}  // namespace clsurf::io::edge_json_test
