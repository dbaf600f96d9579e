// Logs that are still being written: whole records and nothing else, in every format that can be followed; files that are cut,
// replaced or written anew; pipes.

#include "io/formats/growing_log.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "core/error.h"
#include "io/files/compressed.h"
#include "support/temporary_folder.h"

namespace clsurf::io::growing_log_test {
namespace {

using test::read_file;
using test::TemporaryFolder;

constexpr std::size_t count_at = 24;  ///< offset of the record count in a BIIP log (docs/formats/biip.md)

std::string sample(const std::string& name) { return std::string(SAMPLE_LOGS) + "/" + name; }
std::string data(const std::string& name) { return std::string(SAMPLE_DATA) + "/logs/" + name; }

void append(const std::string& path, std::string_view bytes) {
    std::ofstream(path, std::ios::binary | std::ios::app) << bytes;
}

/// A closed BIIP log as it was before it was closed.
std::string not_closed(std::string biip) {
    std::memset(biip.data() + count_at, 0, 8);
    return biip;
}

std::string csv_of(int records) {
    std::string text = "time [s],cmd.x,cmd.y,cmd.z\n";
    for (int i = 0; i < records; ++i) text += std::to_string(i * 0.001) + "," + std::to_string(i * 0.01) + ",2,3\n";
    return text;
}

/// What a reader is expected to make of the complete file.
struct Followed {
    std::string file;
    LogOptions options;
};

/// In the name of the test.
void PrintTo(const Followed& followed, std::ostream* out) { *out << followed.file; }

class GrowingFormat : public testing::TestWithParam<Followed> {};

/// The log comes in pieces that cut records anywhere; old records are forgotten on the way. Each window must hold what the
/// complete log has there.
TEST_P(GrowingFormat, WindowsAreSectionsOfTheCompleteLog) {
    const Followed& followed = GetParam();
    std::string bytes = read_file(sample(followed.file));
    const Log complete = open_log(sample(followed.file), followed.options);
    if (complete.format == "biip") bytes = not_closed(std::move(bytes));
    const TemporaryFolder folder;
    const std::string path = folder.write("log", "");
    GrowingLog log(path, followed.options);
    std::mt19937 random(26);
    std::size_t written = 0;
    int windows = 0;
    while (written < bytes.size()) {
        const std::size_t piece = std::min<std::size_t>(bytes.size() - written, 1 + random() % 100'000);
        append(path, std::string_view(bytes).substr(written, piece));
        written += piece;
        while (log.read(2000) > 0) {}
        if (!log.known() || log.end() - log.first() < 100) continue;
        const Log window = log.window();
        ++windows;
        ASSERT_EQ(window.records, log.end() - log.first());
        ASSERT_LE(log.end(), complete.records);
        EXPECT_DOUBLE_EQ(window.period, complete.period);
        for (const char* name : {"cmd.x", "cmd.z", "line"}) {
            const Channel* whole = complete.find(name);
            const Channel* part = window.find(name);
            ASSERT_EQ(whole == nullptr, part == nullptr) << name;
            if (whole == nullptr) continue;
            for (const PointIndex i : {PointIndex{0}, window.records / 2, window.records - 1})
                ASSERT_EQ(part->values.at(i), whole->values.at(log.first() + i)) << name << " " << log.first() + i;
        }
        log.forget(log.end() - static_cast<PointIndex>(random() % 5000));
    }
    EXPECT_GT(windows, 3);
    EXPECT_EQ(log.end(), complete.records);
    EXPECT_EQ(log.whole().bytes.size(), bytes.size());
    EXPECT_FALSE(log.ended());
}

INSTANTIATE_TEST_SUITE_P(Formats, GrowingFormat,
                         testing::Values(Followed{"planted_zigzag.biip", {}}, Followed{"dome_loops.halscope.csv", {}},
                                         Followed{"dome_loops.halsampler.txt",
                                                  {{}, data("dome_loops.mapping.toml"), {}}},
                                         Followed{"mixed.csv", {{}, {}, 0.001}},
                                         Followed{"petal_spiral.raw", {data("petal_spiral.layout.toml"), {}, {}}}),
                         [](const auto& instance) {
                             std::string name = instance.param.file;
                             std::replace(name.begin(), name.end(), '.', '_');
                             return name;
                         });

TEST(GrowingLog, ABiipLogEndsWhenItsNumberOfRecordsIsThere) {
    const std::string closed = read_file(sample("planted_zigzag.biip"));
    const TemporaryFolder folder;
    const std::string path = folder.write("log", not_closed(closed));
    const LogOptions options;
    GrowingLog log(path, options);
    while (log.read(10'000) > 0) {}
    EXPECT_EQ(log.end(), 30'774);
    EXPECT_FALSE(log.ended());
    std::fstream(path, std::ios::binary | std::ios::in | std::ios::out)
        .seekp(count_at)
        .write(closed.data() + count_at, 8);
    EXPECT_EQ(log.read(10'000), 0);
    EXPECT_TRUE(log.ended());
}

TEST(GrowingLog, HalfALineIsNoRecord) {
    const TemporaryFolder folder;
    const std::string path = folder.write("log.csv", csv_of(10) + "0.010000,0.1");
    const LogOptions options;
    GrowingLog log(path, options);
    (void)log.read(1000);
    EXPECT_EQ(log.end(), 10);
    EXPECT_TRUE(log.window().diagnostics.empty());
    EXPECT_EQ(log.whole_records().bytes.size(), csv_of(10).size());
    append(path, "00000,2,3\n# a comment\n\n0.011");
    (void)log.read(1000);
    EXPECT_EQ(log.end(), 11);
    EXPECT_DOUBLE_EQ(log.window().find("cmd.x")->values.at(10), 0.1);
}

TEST(GrowingLog, HalfAHeadIsWaitedFor) {
    const TemporaryFolder folder;
    const std::string path = folder.write("log.csv", "time [s],cmd.x,cm");
    const LogOptions options;
    GrowingLog log(path, options);
    (void)log.read(1000);
    EXPECT_FALSE(log.known());
    append(path, csv_of(9).substr(17));
    (void)log.read(1000);
    EXPECT_TRUE(log.known());
    EXPECT_EQ(log.end(), 9);
}

/// A text of 50 records, read so far.
class GrowingText : public testing::Test {
protected:
    void SetUp() override { (void)log.read(1000); }

    const TemporaryFolder folder;
    const std::string path = folder.write("log.csv", csv_of(50));
    const LogOptions options{};
    GrowingLog log{path, options};
};

TEST_F(GrowingText, ThatBecomesShorterIsAnError) {
    std::filesystem::resize_file(path, 100);
    try {
        (void)log.read(1000);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(error.diagnostic().text.find("became shorter while it was followed: 100 bytes"), std::string::npos);
    }
}

TEST_F(GrowingText, ThatIsReplacedIsAnError) {
    std::filesystem::rename(folder.write("other.csv", csv_of(80)), path);
    EXPECT_THROW((void)log.read(1000), InputError);
}

TEST_F(GrowingText, ThatIsWrittenAnewIsAnError) {
    folder.write("log.csv", "t;x\n" + csv_of(80));  // the same file, longer, and with another head
    EXPECT_THROW((void)log.read(1000), InputError);
}

TEST_F(GrowingText, WithoutItsNameEnds) {
    EXPECT_FALSE(log.ended());
    std::filesystem::rename(path, folder / "run.csv");
    EXPECT_EQ(log.read(1000), 0);
    EXPECT_TRUE(log.ended());
    EXPECT_EQ(log.whole().bytes.size(), csv_of(50).size());
}

TEST(GrowingLog, APipeEndsWhenItsWriterClosesIt) {
    const TemporaryFolder folder;
    const std::string path = folder / "pipe";
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    const std::string bytes = csv_of(20'000);
    const LogOptions options;
    GrowingLog log(path, options);
    EXPECT_EQ(log.read(1000), 0);
    EXPECT_FALSE(log.ended()) << "nobody has written yet";
    std::thread writer([&] { append(path, bytes); });
    while (!log.ended()) {
        if (log.read(1000) == 0) log.wait(0.05);
        log.forget(log.end() - 10);
    }
    writer.join();
    EXPECT_EQ(log.end(), 20'000);
    EXPECT_EQ(log.first(), 19'990);
    EXPECT_EQ(log.whole().text(), bytes) << "the copy of the stream";
}

TEST(GrowingLog, FormatsThatAreWrittenAsAWholeAreRefused) {
    const TemporaryFolder folder;
    const LogOptions options;
    GrowingLog json(sample("edge_300.json"), options);
    EXPECT_THROW((void)json.read(1'000'000), InputError);
    GrowingLog packed(data("planted_zigzag.biip.xz"), options);
    EXPECT_THROW((void)packed.read(1'000'000), InputError);
    const LogOptions events{{}, data("dome_loops.events.mapping.toml"), {}};
    GrowingLog with_events(sample("dome_loops.signals.csv"), events);
    EXPECT_THROW((void)with_events.read(1'000'000), UsageError);
}

}  // namespace
}  // namespace clsurf::io::growing_log_test
