#include "io/readers/tool_table_file.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace clsurf::io::tool_table_file_test {
namespace {

ToolTable read(const std::string& text) {
    const test::TemporaryFolder folder;
    return read_tool_table(map_file(folder.write("part.tbl", text)));
}

std::string error_of(const std::string& text) {
    try {
        (void)read(text);
    } catch (const InputError& error) { return error.what(); }
    return "";
}

TEST(ToolTableFile, ReadsLengthsDiametersAndRemarks) {
    const ToolTable table = read("; the shop's tools\nT1 P1 D6.0 Z12.3 ;ball nose\r\n\nt20p2z+1x-2.5d.5 I10 J-20 Q3\n");
    ASSERT_EQ(table.tools.size(), 2u);
    EXPECT_DOUBLE_EQ(table.find(1)->diameter, 6.0);
    EXPECT_DOUBLE_EQ(table.find(1)->offset.z(), 12.3);
    EXPECT_DOUBLE_EQ(table.find(20)->offset.x(), -2.5);
    EXPECT_DOUBLE_EQ(table.find(20)->diameter, 0.5);
    EXPECT_DOUBLE_EQ(table.find(20)->back_angle, -20);
    EXPECT_EQ(table.find(20)->orientation, 3);
    EXPECT_EQ(table.unit_mm, 1);
}

TEST(ToolTableFile, SaysInWhichLineItCannotBeRead) {
    EXPECT_NE(error_of("T1 D6\nT2 D\n").find("part.tbl:2:5: error: expected a number after D"), std::string::npos);
    EXPECT_NE(error_of("T1\nP2 D6\n").find("part.tbl:2:1: error: a tool needs its number (T)"), std::string::npos);
    EXPECT_NE(error_of("T1\nT1\n").find("part.tbl:2:1: error: tool 1 is given twice"), std::string::npos);
    EXPECT_NE(error_of("T1 D6 D7\n").find(":1:7: error: D is given twice"), std::string::npos);
    EXPECT_NE(error_of("T1 D1.2.3\n").find(":1:8: error: malformed number"), std::string::npos);
    EXPECT_NE(error_of("T1.5\n").find("T must be a whole number"), std::string::npos);
    EXPECT_NE(error_of("T1 U2\n").find("offset of axis U is not supported"), std::string::npos);
    EXPECT_NE(error_of("T1 E2\n").find("word E is not known"), std::string::npos);
    EXPECT_NE(error_of("; nothing\n").find("holds no tools"), std::string::npos);
}

}  // namespace
}  // namespace clsurf::io::tool_table_file_test
