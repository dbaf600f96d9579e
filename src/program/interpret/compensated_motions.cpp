// Cutter compensation as the interpreter runs it: when it begins and ends, and what it forbids.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "program/interpret/interpreter_state.h"

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

}  // namespace

void Interpreter::start_compensation(int code, const Block& block, std::size_t column) {
    if (compensation_.path.on()) fail("cutter compensation is on already: G40 first", column);
    if (state_.plane_axis == 0) fail("cutter compensation needs the XY or the XZ plane (G17, G18)", column);
    double diameter = tools_.in_spindle.diameter;
    if (code == 411 || code == 421) {
        if (!block.words.given('D')) fail(code_text(code) + " needs the tool's diameter (D)", column);
        diameter = block.words.of('D') * state_.unit_mm;
        const double orientation = block.words.given('L') ? block.words.of('L') : 0;
        if (!(orientation >= 0 && orientation <= most_orientation)) fail("a tool's orientation (L) is 0 … 9", column);
    } else if (block.words.given('D') && block.words.of('D') != 0) {
        diameter = tool_of(static_cast<int>(std::clamp(std::round(block.words.of('D')), 0.0, 1e6)), column).diameter;
    }
    if (diameter == 0) {
        note(Severity::warning, "program.cutter-compensation",
             code_text(code) + ": the tool has no diameter, the path is read as programmed", column);
    }
    compensation_.path.start(code == 410 || code == 411, 0.5 * diameter);
    event("cutter-compensation", fmt::format("{} D{:g}", code_text(code), diameter));
}

/// G41 and G42 of the controls: Fanuc's D is a row of the table, the others take the tool in the
/// spindle. Mirroring turns the side round.
void Interpreter::compensate_by_table(int code, const Block& block, std::size_t column) {
    if (tools_.table.tools.empty()) {
        note(Severity::warning, "program.cutter-compensation",
             code_text(code) +
                 ": the path is read as programmed, without cutter compensation (--tools gives the diameters)",
             column);
        return;
    }
    double diameter = tools_.in_spindle.diameter;
    if (rules_->tools.radius_by_d) {
        if (block.words.given('D'))
            tools_.radius_row = static_cast<int>(std::clamp(std::round(block.words.of('D')), 0.0, 1e6));
        diameter = tool_of(tools_.radius_row, column).diameter;
    }
    if (compensation_.path.on()) stop_compensation();
    if (diameter == 0) {
        note(Severity::warning, "program.cutter-compensation",
             code_text(code) + ": the tool has no diameter, the path is read as programmed", column);
    }
    const std::optional<ProgramFrame::Circle> circle = state_.frame.circle(state_.plane_axis);
    if (!circle) fail("cutter compensation in a tilted or unevenly scaled frame is not supported", column);
    compensation_.path.start((code == 410) != circle->reversed, 0.5 * diameter);
    compensation_.enters_beside = true;
    event("cutter-compensation", fmt::format("{} D{:g}", code_text(code), diameter));
}

/// The controls go to the point beside the begin of the first compensated motion: the ends of the
/// motions since G41 are moved there when that one is known.
void Interpreter::enter_compensation(const Vec2& direction) {
    const int axis = state_.plane_axis;
    const Vec2 beside = compensation_.path.enter_beside(in_plane(state_.position, axis), direction);
    Motions& m = program_.motions;
    for (std::size_t i = compensation_.open_motions; i < m.end.size() && compensation_.entry_programmed; ++i)
        m.end[i] = Xyz(from_plane(beside, m.end[i].vec()[axis], axis));
    compensation_.enters_beside = compensation_.entry_programmed = false;
}

void Interpreter::stop_compensation() {
    compensation_.enters_beside = compensation_.entry_programmed = false;
    const std::string error = compensation_.path.finish();
    if (!error.empty()) fail(error);
    if (compensation_.path.entered()) {
        compensation_.ended_at = program_.motions.size();
        part_from_machine(tool_position() - state_.position);
    }
    compensation_.path.stop();
    event("cutter-compensation", "G40");
}

void Interpreter::refuse_in_compensation(int code, const Block& block, std::size_t column) const {
    const std::span<const int> forbidden = rules_->motion.forbidden_in_compensation;
    if (!compensation_.path.on() || forbidden.empty()) return;
    const bool other_plane = std::find(plane_codes.begin(), plane_codes.end(), code) != plane_codes.end() &&
                             plane_codes[static_cast<std::size_t>(state_.plane_axis)] != code;
    const bool system_moves =
        code == 100 && block.words.given('L') && (block.words.of('L') == 2 || block.words.of('L') == 20);
    if (other_plane || system_moves || std::find(forbidden.begin(), forbidden.end(), code) != forbidden.end()) {
        fail(code_text(code) + " cannot be used while cutter compensation is on", column);
    }
}

Vec3 Interpreter::tool_position() const {
    if (!compensation_.path.entered()) return state_.position;
    return from_plane(compensation_.path.centre(), state_.position[state_.plane_axis], state_.plane_axis);
}

void Interpreter::compensated_straight(MotionKind kind, const Vec3& end, const Vec3& rotary) {
    if (!compensation_.path.active()) {
        straight(kind, end, rotary);
        return;
    }
    const int axis = state_.plane_axis;
    if (compensation_.enters_beside) {
        const Vec2 displacement = in_plane(end, axis) - in_plane(state_.position, axis);
        if (!compensation_.entry_programmed || displacement.isZero()) {
            if (!compensation_.entry_programmed) compensation_.open_motions = program_.motions.end.size();
            compensation_.entry_programmed = compensation_.entry_programmed || !displacement.isZero();
            if (!compensation_.entry_programmed) compensation_.open_motions = program_.motions.end.size() + 1;
            straight(kind, end, rotary);
            return;
        }
        enter_compensation(displacement.normalized());
    }
    push_compensated(compensation_.path.line(in_plane(state_.position, axis), in_plane(end, axis)), kind, end, rotary);
}

void Interpreter::compensated_arc(const Arc& arc, bool clockwise, const Vec3& end, const Vec3& rotary) {
    const int axis = state_.plane_axis;
    if (compensation_.enters_beside) {
        const Vec2 out = in_plane(state_.position, axis) - in_plane(arc.centre.vec(), axis);
        const Vec2 tangent = clockwise ? Vec2(out.y(), -out.x()) : Vec2(-out.y(), out.x());
        if (!compensation_.entry_programmed) fail("cutter compensation must begin with a straight motion");
        enter_compensation(tangent.normalized());
    }
    const CompensatedStep step = compensation_.path.arc(in_plane(state_.position, axis), in_plane(end, axis),
                                                        in_plane(arc.centre.vec(), axis), !clockwise);
    push_compensated(step, MotionKind::feed, end, rotary, arc);
}

/// The motions of a step: along the axis of the plane only the last of them moves. `arc` gives turns.
void Interpreter::push_compensated(const CompensatedStep& step, MotionKind kind, const Vec3& end, const Vec3& rotary,
                                   Arc arc) {
    if (!step.error.empty()) fail(step.error);
    const int axis = state_.plane_axis;
    Motions& m = program_.motions;
    if (step.moves_corner) {
        for (std::size_t i = compensation_.open_motions; i < m.end.size(); ++i) {
            m.end[i] = Xyz(from_plane(step.corner, m.end[i].vec()[axis], axis));
        }
    }
    const double level = state_.position[axis];
    const bool along_axis = in_plane(end, axis) == in_plane(state_.position, axis) && !step.moves.back().is_arc;
    if (!along_axis) compensation_.open_motions = m.end.size() + step.moves.size() - 1;
    Vec3 from = step.moves_corner ? from_plane(step.corner, level, axis) : tool_position();
    if (!m.end.empty()) from = m.end.back().vec();
    for (std::size_t i = 0; i < step.moves.size(); ++i) {
        const CompensatedMove& move = step.moves[i];
        const bool last = i + 1 == step.moves.size();
        const Vec3 to = from_plane(move.end, last ? end[axis] : level, axis);
        const Vec3& turned = last ? rotary : state_.rotary;
        if (move.is_arc && kind != MotionKind::rapid) {
            Arc around;
            around.axis = static_cast<std::uint8_t>(axis);
            around.centre = Xyz(from_plane(move.centre, level, axis));
            around.turns = last ? arc.turns : 1;
            push_arc(around, !move.counter_clockwise, from, to, turned);
        } else {
            straight(kind, to, turned);
        }
        from = to;
    }
    state_.position = end;
}

}  // namespace clsurf
