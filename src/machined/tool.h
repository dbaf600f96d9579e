#pragma once
// Tool: the outline of the cutting edge, as far as it is needed for the as-machined surface.

#include <cstdint>
#include <optional>
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
/// The tool of a row of a tool table. Its remark contains a word that parse_tool() reads ("ball:6"), or one of the words
/// "ball", "ballnose", "flat", "endmill" with a diameter [mm]. nullopt: the shape is not given.
[[nodiscard]] std::optional<CuttingTool> tool_of_remark(std::string_view remark, double diameter);
/// The inverse of parse_tool(): "ball:6".
[[nodiscard]] std::string to_text(const CuttingTool& tool);

}  // namespace clsurf
