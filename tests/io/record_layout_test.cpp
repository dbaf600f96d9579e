#include "io/formats/log_format.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace clsurf::io::record_layout_test {
namespace {

Log open(const test::TemporaryFolder& folder, const std::string& bytes, const std::string& layout) {
    LogOptions options;
    options.layout = folder.write("l.toml", layout);
    return open_log(folder.write("run.raw", bytes), options);
}

const char* const layout =
    "[log]\nendian = \"big\"\nheader_bytes = 2\nrecord_bytes = 3\nperiod_s = 0.001\n"
    "[[channel]]\nname = \"cmd.x\"\ntype = \"i16\"\noffset = 1\nunit = \"mm\"\nscale = 0.5\nbias = 10\n";

TEST(RecordLayout, ReadsBigEndianValuesWithScaleAndBias) {
    const test::TemporaryFolder folder;
    // Records: skip one byte, then 0x0102 and 0xFFFE (−2); one byte is left over.
    const Log log =
        open(folder, std::string("HH") + std::string("\x00\x01\x02", 3) + std::string("\x00\xFF\xFE", 3) + "?", layout);
    EXPECT_EQ(log.records, 2);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(0), 0x0102 * 0.5 + 10);
    EXPECT_DOUBLE_EQ(log.find("cmd.x")->values.at(1), 9.0);
    EXPECT_EQ(log.diagnostics.count("log.unclosed"), 1u);
}

TEST(RecordLayout, RefusesAChannelThatDoesNotFitItsRecord) {
    const test::TemporaryFolder folder;
    std::string wrong = layout;
    wrong.replace(wrong.find("offset = 1"), 10, "offset = 2");
    try {
        (void)open(folder, "HHabcdef", wrong);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.diagnostic().text, "channel 'cmd.x' at byte 2 does not fit a record of 3 bytes");
    }
}

TEST(RecordLayout, SuggestsTheNearestTypeAndKey) {
    const test::TemporaryFolder folder;
    std::string wrong = layout;
    wrong.replace(wrong.find("i16"), 3, "i61");
    try {
        (void)open(folder, "HHabcdef", wrong);
        FAIL();
    } catch (const InputError& error) { EXPECT_EQ(error.diagnostic().hint, "did you mean 'i16'?"); }
}

}  // namespace
}  // namespace clsurf::io::record_layout_test
