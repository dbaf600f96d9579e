#include "machined/tool.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace clsurf::tool_test {
namespace {

TEST(CuttingTool, ReadsItsThreeKinds) {
    EXPECT_EQ(parse_tool("ball:6"), (CuttingTool{ToolKind::ball, 3, 3}));
    EXPECT_EQ(parse_tool("bull:10,1.5"), (CuttingTool{ToolKind::bull, 5, 1.5}));
    EXPECT_EQ(parse_tool("flat:8"), (CuttingTool{ToolKind::flat, 4, 0}));
    for (const char* text : {"ball:6", "bull:10,1.5", "flat:8"}) EXPECT_EQ(to_text(parse_tool(text)), text);
}

TEST(CuttingTool, RefusesWhatIsNone) {
    for (const char* text : {"", "ball", "ball:", "ball:0", "ball:-6", "ball:6,1", "ball:6mm", "ball:nan", "ball:inf",
                             "bull:10", "bull:10,5", "bull:10,0", "cone:6", "flat:"}) {
        EXPECT_THROW((void)parse_tool(text), UsageError) << text;
    }
}

}  // namespace
}  // namespace clsurf::tool_test
