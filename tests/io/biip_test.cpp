#include "io/formats/biip.h"

#include <cstring>

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/files/crc32c.h"
#include "io/formats/log_format.h"
#include "support/temporary_folder.h"

namespace clsurf::io::biip_test {
namespace {

TEST(Crc32c, HasTheCheckValueOfItsDefinition) {
    const std::string digits = "123456789";
    EXPECT_EQ(crc32c(std::as_bytes(std::span(digits.data(), digits.size()))), 0xE3069283u);
}

/// A log of two channels and three records.
struct Made {
    std::vector<std::int32_t> x{-1, 0, 2'000'000};
    std::vector<std::uint32_t> line{0, 7, 4'000'000'000u};
    std::vector<Channel> channels() const {
        return {{"cmd.x", "mm", {reinterpret_cast<const std::byte*>(x.data()), 4, 3, ScalarType::i32, false, 1e-6, 0}},
                {"line", "", {reinterpret_cast<const std::byte*>(line.data()), 4, 3, ScalarType::u32, false, 1, 0}}};
    }
};

std::string write_made(const test::TemporaryFolder& folder) {
    const std::string path = folder / "a.biip";
    write_biip(path, Made().channels(), 3, 0.001,
               R"({"programs":[{"name":"a.nc","sha256":"00"}],"work_offset":[1,2,3]})");
    return path;
}

Log open(const std::string& path) { return open_log(path, {}); }

std::string error_of(const std::string& path) {
    try {
        (void)open(path);
    } catch (const InputError& error) { return error.diagnostic().text; }
    return "";
}

TEST(Biip, ReadsBackWhatItWrote) {
    const test::TemporaryFolder folder;
    const Log log = open(write_made(folder));
    EXPECT_EQ(log.format, "biip");
    EXPECT_EQ(log.records, 3);
    EXPECT_TRUE(log.closed);
    EXPECT_DOUBLE_EQ(log.period, 0.001);
    EXPECT_EQ(log.find("cmd.x")->values.type, ScalarType::i32);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(2), 2.0);
    EXPECT_DOUBLE_EQ(log.find("line")->values.at(2), 4e9);
    EXPECT_EQ(log.programs.at(0).name, "a.nc");
    EXPECT_EQ(log.work_offset->z(), 3.0);
    EXPECT_TRUE(log.diagnostics.empty());
}

TEST(Biip, HasThePeriodOfTheOptions) {
    const test::TemporaryFolder folder;
    LogOptions options;
    options.period = 0.002;
    EXPECT_DOUBLE_EQ(open_log(write_made(folder), options).period, 0.002);
}

TEST(Biip, HoldsShortNamesOfChannelsThatHaveLongOnes) {
    Log log;
    log.channels.push_back({"/Nck/!SD/nckServoDataCmdTorque32 [u1, 4]", "Newtonmetre", {}});
    log.channels.push_back({"/Nck/!SE/nckServoDataCmdTorque32 [u1, 4]", "", {}});
    log.channels.push_back({"cmd.x", "mm", {}});
    EXPECT_EQ(fit_biip(log).count("log.name"), 3u);
    // The last 23 bytes; the second of them marked: two bytes less of it.
    EXPECT_EQ(log.channels[0].name, "DataCmdTorque32 [u1, 4]");
    EXPECT_EQ(log.channels[0].unit, "");
    EXPECT_EQ(log.channels[1].name.size(), 23u);
    EXPECT_TRUE(log.channels[1].name.ends_with("~2"));
    EXPECT_EQ(log.channels[2].name, "cmd.x");
}

TEST(Biip, TakesEveryWholeRecordOfAFileThatWasNotClosed) {
    const test::TemporaryFolder folder;
    std::string bytes = test::read_file(write_made(folder));
    const std::uint64_t none = 0;
    std::memcpy(bytes.data() + 24, &none, 8);
    bytes.resize(bytes.size() - 3);
    const Log log = open(folder.write("b.biip", bytes));
    EXPECT_FALSE(log.closed);
    EXPECT_EQ(log.records, 2);
    ASSERT_EQ(log.diagnostics.count("log.unclosed"), 1u);
    EXPECT_NE(log.diagnostics.kept()[0].text.find("5 more bytes"), std::string::npos);
}

TEST(Biip, RefusesADamagedHeaderByItsChecksum) {
    const test::TemporaryFolder folder;
    const std::string bytes = test::read_file(write_made(folder));
    for (const std::size_t at : {14u, 33u, 50u, 60u, 130u, 150u}) {
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x40);
        EXPECT_NE(error_of(folder.write("c.biip", damaged)), "") << at;
    }
}

TEST(Biip, RefusesAnotherMajorVersionAndAcceptsAnyMinor) {
    const test::TemporaryFolder folder;
    std::string bytes = test::read_file(write_made(folder));
    const auto seal = [&] {
        std::string header = bytes.substr(0, bytes.size() - 24);
        std::memset(header.data() + 24, 0, 8);
        std::memset(header.data() + 44, 0, 4);
        const std::uint32_t crc = crc32c(std::as_bytes(std::span(header.data(), header.size())));
        std::memcpy(bytes.data() + 44, &crc, 4);
    };
    bytes[10] = 9;
    seal();
    EXPECT_EQ(open(folder.write("d.biip", bytes)).diagnostics.count("log.minor-version"), 1u);
    bytes[8] = 2;
    seal();
    EXPECT_EQ(error_of(folder.write("e.biip", bytes)), "BIIP version 2.9, expected 1.x");
}

TEST(Biip, AnswersEveryCutWithAnErrorOrFewerRecords) {
    const test::TemporaryFolder folder;
    const std::string bytes = test::read_file(write_made(folder));
    const std::size_t header = bytes.size() - 24;
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const std::string path = folder.write("f.biip", bytes.substr(0, size));
        if (size < header) {
            EXPECT_NE(error_of(path), "") << size;
        } else {
            const Log log = open(path);
            EXPECT_EQ(log.records, static_cast<PointIndex>((size - header) / 8)) << size;
            EXPECT_FALSE(log.closed);
        }
    }
}

TEST(Biip, SurvivesEveryChangedByteOfItsHeader) {
    const test::TemporaryFolder folder;
    const std::string bytes = test::read_file(write_made(folder));
    for (std::size_t at = 0; at < bytes.size() - 24; ++at) {
        for (const int bit : {0, 7}) {
            std::string damaged = bytes;
            damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
            const std::string path = folder.write("g.biip", damaged);
            try {
                (void)open(path);
            } catch (const InputError&) {  // expected of most
            }
        }
    }
}

}  // namespace
}  // namespace clsurf::io::biip_test
