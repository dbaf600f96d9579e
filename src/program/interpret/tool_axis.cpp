// Tool centre point control, and tool axes that are programmed as vectors: I J K under G43.5 of Fanuc,
// A3= B3= C3= under TRAORI of Siemens. The corresponding angles follow from the machine's kinematics.
//
// Facts: Fanuc, Series 30i operator's manual, "Tool center point control" (type 2); Siemens, SINUMERIK
// 840D sl programming manual Job planning, "3- to 5-axis transformation (TRAORI)"; Heidenhain, iTNC 530
// user's manual, M128 and M129.

#include "program/interpret/tool_axis.h"

#include <array>
#include <limits>
#include <optional>

#include "program/interpret/interpreter_state.h"

namespace clsurf {

void control_tool_centre_point(Interpreter& in, bool on, const std::string& text) {
    if (!on && !in.five_axis_.tool_centre_point) return;
    in.five_axis_.tool_centre_point = on;
    in.five_axis_.switched_on_by = text;
    in.five_axis_.axis_words = on && text == "G43.5";
    in.state_.tool_axis.setConstant(std::numeric_limits<double>::quiet_NaN());
    in.event("tool-centre-point", text, ToolCentrePointControl{on});
}

bool take_tool_axis(Interpreter& in, const Block& block) {
    if (!in.five_axis_.tool_centre_point && !in.five_axis_.tilted) return false;
    const bool straight = in.state_.motion == MotionMode::rapid || in.state_.motion == MotionMode::feed;
    Vec3 axis = Vec3::Zero();
    bool given = false;
    for (int k = 0; k < 3; ++k) {
        if (in.five_axis_.axis_words && straight && block.words.given("IJK"[k])) {
            axis[k] = block.words.of("IJK"[k]);
            given = true;
        }
        constexpr std::array<std::string_view, 3> names{"A3", "B3", "C3"};
        if (const std::optional<double> value = block.value_of(names[static_cast<std::size_t>(k)])) {
            axis[k] = *value;
            given = true;
        }
    }
    constexpr std::uint32_t angles = Words::bit('A') | Words::bit('B') | Words::bit('C');
    if (!given) {
        if ((block.words.has & angles) != 0) in.state_.tool_axis.setConstant(std::numeric_limits<double>::quiet_NaN());
        return false;
    }
    if (!(axis.norm() > 0)) in.fail("the tool axis is a vector of length zero");
    in.state_.tool_axis = in.state_.frame.direction_to_work(axis.normalized());
    return true;
}

}  // namespace clsurf
