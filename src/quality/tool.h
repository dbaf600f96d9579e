#pragma once
// Tool: the cutting edge's outline, as far as the formed surface needs it.

#include <string>
#include <string_view>

namespace clsurf {

enum class ToolKind : std::uint8_t { ball, bull, flat };

struct CuttingTool {
    ToolKind kind = ToolKind::ball;
    double radius = 0;  ///< [mm] of the tool
    double corner = 0;  ///< [mm] of its edge: the radius for a ball, 0 for a flat tool

    friend bool operator==(const CuttingTool&, const CuttingTool&) = default;
};

/// "ball:D", "bull:D,R", "flat:D" [mm]. Throws UsageError.
[[nodiscard]] CuttingTool parse_tool(std::string_view text);
/// The same back, "ball:6".
[[nodiscard]] std::string to_text(const CuttingTool& tool);

}  // namespace clsurf
