// Tilted planes (CYCLE800, G68.2, PLANE). The program is then in the coordinates of a plane of the workpiece that is
// normal to the tool: a frame rotates its positions, which are those of the tip, and the tool axis is a vector, the
// plane's normal. The corresponding angles follow from the machine's kinematics.

#include "program/interpret/tilted_plane.h"

#include <limits>

#include "program/interpret/compensated_motions.h"
#include "program/interpret/interpreter_state.h"

namespace clsurf {

void begin_tilted_plane(Interpreter& in, const std::string& text) {
    in.five_axis_.tilted = true;
    in.state_.tool_axis.setConstant(std::numeric_limits<double>::quiet_NaN());
    in.event("tool-centre-point", "tilted plane " + text, ToolCentrePointControl{true});
}

void end_tilted_plane(Interpreter& in, const std::string& text) {
    if (!in.five_axis_.tilted) return;
    in.five_axis_.tilted = false;
    in.state_.tool_axis.setConstant(std::numeric_limits<double>::quiet_NaN());
    in.event("tool-centre-point", in.five_axis_.tool_centre_point ? in.five_axis_.switched_on_by : text,
             ToolCentrePointControl{in.five_axis_.tool_centre_point});
}

void turn_to_plane(Interpreter& in, const Vec3& axis, bool keeps_tip, const std::string& text) {
    in.state_.tool_axis = axis;
    if (in.state_.position.array().isNaN().any()) return;  // the first motion turns them
    if (!keeps_tip) in.event("tool-centre-point", text, ToolCentrePointControl{false});
    in.push(MotionKind::rapid, tool_position(in.compensation_, in.state_), in.state_.rotary,
            std::numeric_limits<float>::quiet_NaN());
    if (!keeps_tip) in.event("tool-centre-point", "tilted plane " + text, ToolCentrePointControl{true});
}

}  // namespace clsurf
