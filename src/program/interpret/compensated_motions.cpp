// Cutter compensation in the interpreter: its begin and end, and forbidden codes.

#include "program/interpret/compensated_motions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "program/interpret/interpreter_state.h"
#include "program/interpret/tools.h"

namespace clsurf {
namespace {

constexpr std::array<int, 3> plane_codes{19_g, 18_g, 17_g};  ///< by axis of rotation
constexpr int most_orientation = 9;

Vec2 in_plane(const Vec3& p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

Vec3 from_plane(const Vec2& p, double along, int axis) {
    Vec3 q;
    q[(axis + 1) % 3] = p.x();
    q[(axis + 2) % 3] = p.y();
    q[axis] = along;
    return q;
}

/// The controls go to the point next to the beginning of the first compensated motion: the ends of the motions since
/// G41 are moved there once that motion is known.
void enter_compensation(CompensationState& compensation, const ModalState& state, Motions& motions,
                        const Vec2& direction) {
    const int axis = state.plane_axis;
    const Vec2 beside = compensation.path.enter_at_offset(in_plane(state.position, axis), direction);
    Motions& m = motions;
    for (std::size_t i = compensation.open_motions; i < m.end.size() && compensation.entry_programmed; ++i)
        m.end[i] = Xyz(from_plane(beside, m.end[i].vec()[axis], axis));
    compensation.enters_at_offset = compensation.entry_programmed = false;
}

/// The motions of a step: only the last of them moves along the plane's normal. `arc` gives turns.
void push_compensated(Interpreter& in, const CompensatedStep& step, MotionKind kind, const Vec3& end,
                      const Vec3& rotary, Arc arc = {}) {
    if (!step.error.empty()) in.fail(step.error);
    const int axis = in.state_.plane_axis;
    Motions& m = in.program_.motions;
    if (step.moves_corner) {
        for (std::size_t i = in.compensation_.open_motions; i < m.end.size(); ++i) {
            m.end[i] = Xyz(from_plane(step.corner, m.end[i].vec()[axis], axis));
        }
    }
    const double level = in.state_.position[axis];
    const bool along_axis = in_plane(end, axis) == in_plane(in.state_.position, axis) && !step.moves.back().is_arc;
    if (!along_axis) in.compensation_.open_motions = m.end.size() + step.moves.size() - 1;
    Vec3 from = step.moves_corner ? from_plane(step.corner, level, axis) : tool_position(in.compensation_, in.state_);
    if (!m.end.empty()) from = m.end.back().vec();
    for (std::size_t i = 0; i < step.moves.size(); ++i) {
        const CompensatedMove& move = step.moves[i];
        const bool last = i + 1 == step.moves.size();
        const Vec3 to = from_plane(move.end, last ? end[axis] : level, axis);
        const Vec3& turned = last ? rotary : in.state_.rotary;
        if (move.is_arc && kind != MotionKind::rapid) {
            Arc around;
            around.axis = static_cast<std::uint8_t>(axis);
            around.centre = Xyz(from_plane(move.centre, level, axis));
            around.turns = last ? arc.turns : 1;
            in.push_arc(around, !move.counter_clockwise, from, to, turned);
        } else {
            in.straight(kind, to, turned);
        }
        from = to;
    }
    in.state_.position = end;
}

}  // namespace

void start_compensation(Interpreter& in, int code, const Block& block, std::size_t column) {
    if (in.compensation_.path.on()) in.fail("cutter compensation is on already: G40 first", column);
    if (in.state_.plane_axis == 0) in.fail("cutter compensation needs the XY or the XZ plane (G17, G18)", column);
    double diameter = in.tools_.in_spindle.diameter;
    if (code == 411 || code == 421) {
        if (!block.words.given('D')) in.fail(code_text(code) + " needs the tool's diameter (D)", column);
        diameter = block.words.of('D') * in.state_.unit_mm;
        const double orientation = block.words.given('L') ? block.words.of('L') : 0;
        if (!(orientation >= 0 && orientation <= most_orientation))
            in.fail("a tool's orientation (L) is 0 … 9", column);
    } else if (block.words.given('D') && block.words.of('D') != 0) {
        diameter =
            tool_of(in, static_cast<int>(std::clamp(std::round(block.words.of('D')), 0.0, 1e6)), column).diameter;
    }
    if (diameter == 0) {
        in.note(Severity::warning, "program.cutter-compensation",
                code_text(code) + ": the tool has no diameter, the path is read as programmed", column);
    }
    in.compensation_.path.start(code == 410 || code == 411, 0.5 * diameter);
    in.event("cutter-compensation", fmt::format("{} D{:g}", code_text(code), diameter));
}

void compensate_by_table(Interpreter& in, int code, const Block& block, std::size_t column) {
    if (in.tools_.table.tools.empty()) {
        in.note(Severity::warning, "program.cutter-compensation",
                code_text(code) +
                    ": the path is read as programmed, without cutter compensation (--tools gives the diameters)",
                column);
        return;
    }
    double diameter = in.tools_.in_spindle.diameter;
    if (in.rules_->tools.radius_by_d) {
        if (block.words.given('D'))
            in.tools_.radius_row = static_cast<int>(std::clamp(std::round(block.words.of('D')), 0.0, 1e6));
        diameter = tool_of(in, in.tools_.radius_row, column).diameter;
    }
    if (in.compensation_.path.on()) stop_compensation(in);
    if (diameter == 0) {
        in.note(Severity::warning, "program.cutter-compensation",
                code_text(code) + ": the tool has no diameter, the path is read as programmed", column);
    }
    const std::optional<ProgramFrame::Circle> circle = in.state_.frame.circle(in.state_.plane_axis);
    if (!circle) in.fail("cutter compensation in a tilted or unevenly scaled frame is not supported", column);
    in.compensation_.path.start((code == 410) != circle->reversed, 0.5 * diameter);
    in.compensation_.enters_at_offset = true;
    in.event("cutter-compensation", fmt::format("{} D{:g}", code_text(code), diameter));
}

void stop_compensation(Interpreter& in) {
    in.compensation_.enters_at_offset = in.compensation_.entry_programmed = false;
    const std::string error = in.compensation_.path.finish();
    if (!error.empty()) in.fail(error);
    if (in.compensation_.path.entered()) {
        in.compensation_.ended_at = in.program_.motions.size();
        part_from_machine(in.compensation_, in.program_.motions.size(),
                          tool_position(in.compensation_, in.state_) - in.state_.position);
    }
    in.compensation_.path.stop();
    in.event("cutter-compensation", "G40");
}

void refuse_in_compensation(const Interpreter& in, int code, const Block& block, std::size_t column) {
    const std::span<const int> forbidden = in.rules_->motion.forbidden_in_compensation;
    if (!in.compensation_.path.on() || forbidden.empty()) return;
    const bool other_plane = std::find(plane_codes.begin(), plane_codes.end(), code) != plane_codes.end() &&
                             plane_codes[static_cast<std::size_t>(in.state_.plane_axis)] != code;
    const bool system_moves =
        code == 100 && block.words.given('L') && (block.words.of('L') == 2 || block.words.of('L') == 20);
    if (other_plane || system_moves || std::find(forbidden.begin(), forbidden.end(), code) != forbidden.end()) {
        in.fail(code_text(code) + " cannot be used while cutter compensation is on", column);
    }
}

Vec3 tool_position(const CompensationState& compensation, const ModalState& state) {
    if (!compensation.path.entered()) return state.position;
    return from_plane(compensation.path.centre(), state.position[state.plane_axis], state.plane_axis);
}

void compensated_straight(Interpreter& in, MotionKind kind, const Vec3& end, const Vec3& rotary) {
    if (!in.compensation_.path.active()) {
        in.straight(kind, end, rotary);
        return;
    }
    const int axis = in.state_.plane_axis;
    if (in.compensation_.enters_at_offset) {
        const Vec2 displacement = in_plane(end, axis) - in_plane(in.state_.position, axis);
        if (!in.compensation_.entry_programmed || displacement.isZero()) {
            if (!in.compensation_.entry_programmed) in.compensation_.open_motions = in.program_.motions.end.size();
            in.compensation_.entry_programmed = in.compensation_.entry_programmed || !displacement.isZero();
            if (!in.compensation_.entry_programmed) in.compensation_.open_motions = in.program_.motions.end.size() + 1;
            in.straight(kind, end, rotary);
            return;
        }
        enter_compensation(in.compensation_, in.state_, in.program_.motions, displacement.normalized());
    }
    push_compensated(in, in.compensation_.path.line(in_plane(in.state_.position, axis), in_plane(end, axis)), kind, end,
                     rotary);
}

void compensated_arc(Interpreter& in, const Arc& arc, bool clockwise, const Vec3& end, const Vec3& rotary) {
    const int axis = in.state_.plane_axis;
    if (in.compensation_.enters_at_offset) {
        const Vec2 out = in_plane(in.state_.position, axis) - in_plane(arc.centre.vec(), axis);
        const Vec2 tangent = clockwise ? Vec2(out.y(), -out.x()) : Vec2(-out.y(), out.x());
        if (!in.compensation_.entry_programmed) in.fail("cutter compensation must begin with a straight motion");
        enter_compensation(in.compensation_, in.state_, in.program_.motions, tangent.normalized());
    }
    const CompensatedStep step = in.compensation_.path.arc(in_plane(in.state_.position, axis), in_plane(end, axis),
                                                           in_plane(arc.centre.vec(), axis), !clockwise);
    push_compensated(in, step, MotionKind::feed, end, rotary, arc);
}

}  // namespace clsurf
