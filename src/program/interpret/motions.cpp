// Blocks that move: targets, lines, arcs.

#include "program/interpret/motions.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "core/geometry.h"
#include "core/units.h"
#include "program/interpret/axis_words.h"
#include "program/interpret/compensated_motions.h"
#include "program/interpret/curves.h"
#include "program/interpret/cycles.h"
#include "program/interpret/interpreter_state.h"
#include "program/interpret/path_modes.h"
#include "program/interpret/threading.h"
#include "program/interpret/tool_axis.h"

namespace clsurf {
namespace {

constexpr std::uint32_t rotary_axes = Words::bit('A') | Words::bit('B') | Words::bit('C');
constexpr std::uint32_t other_axes = Words::bit('U') | Words::bit('V') | Words::bit('W');
constexpr std::uint32_t centres = Words::bit('I') | Words::bit('J') | Words::bit('K') | Words::bit('R');
constexpr int most_turns = 100'000;
constexpr int first_probed_parameter = 5061, probe_result_parameter = 5070;

bool names_motion(const Block& block) {
    const auto* first = block.words.g.data();
    return std::any_of(first, first + block.words.g_count, [](std::int32_t code) { return code == 0 || code == 10; });
}

/// Refuses turns or spirals in the form of another dialect: P, L and Q with an arc.
void refuse_turns(const Interpreter& in, const Block& block) {
    if (block.words.m_count > 0) return;
    for (const RefusedLetter& row : in.rules_->motion.refused_at_arcs) {
        if (!block.words.given(row.letter)) continue;
        in.fail(fmt::format("{} in a block with an arc is not known in {}", row.letter, in.program_.dialect->name),
                block.words.column[static_cast<std::size_t>(row.letter - 'A')], row.hint);
    }
}

/// An arc that its frame turns into an ellipse, or tilts out of the principal planes.
void flatten_arc(Interpreter& in, const Arc& arc, bool clockwise, const Vec3& begin, const Vec3& end,
                 const Vec3& rotary) {
    if (in.compensation_.path.on())
        in.fail("cutter compensation of an arc in a tilted or unevenly scaled frame is not supported");
    // The frame may scale the chords' error.
    const Vec3 u = in.state_.frame.direction_to_work(Vec3::Unit((arc.axis + 1) % 3));
    const Vec3 v = in.state_.frame.direction_to_work(Vec3::Unit((arc.axis + 2) % 3));
    const double stretch = std::max(1.0, std::hypot(u.norm(), v.norm()));
    const std::vector<Vec3> chords = arc_chords(arc, clockwise, begin, end, arc_chord_error / stretch);
    const Vec3 turned_from = in.state_.rotary;
    for (std::size_t k = 0; k < chords.size(); ++k) {
        const double part = static_cast<double>(k + 1) / static_cast<double>(chords.size());
        in.straight(MotionKind::spline, in.state_.frame.to_work(chords[k]),
                    turned_from + part * (rotary - turned_from));
    }
}

void move_on_arc(Interpreter& in, const Block& block, bool clockwise) {
    if (in.compensation_.ended_at == in.program_.motions.size())
        in.fail("the first motion after cutter compensation (G40) must be a straight one");
    ArcWords words;
    // In programmed coordinates; the frame transforms the arc as a whole.
    words.begin = in.state_.programmed();
    words.begin = words.begin.array().isNaN().select(0.0, words.begin);
    words.end = in.this_block_.machine_coordinates ? in.state_.frame.to_programmed(target_of(in, block, true))
                                                   : read_axes(in, block, false);
    words.end = words.end.array().isNaN().select(words.begin, words.end);
    words.axis = in.state_.plane_axis;
    words.clockwise = clockwise;
    if (in.rules_->arc != nullptr && in.rules_->arc(in, block, words)) {
        clockwise = words.clockwise;
    } else if (block.words.given('R')) {
        words.has_radius = true;
        words.radius = block.words.of('R') * in.state_.unit_mm;
    } else {
        words.centre = words.begin;
        bool any = false;
        for (int k = 0; k < 3; ++k) {
            const char letter = "IJK"[k];
            if (k == words.axis || !block.words.given(letter)) continue;
            any = true;
            const std::uint32_t bit = Words::bit(letter);
            const bool absolute = in.state_.centre_absolute || (block.absolute & bit) != 0;
            const double value = block.words.of(letter) * in.state_.unit_mm;
            words.centre[k] = absolute ? value : words.begin[k] + value;
        }
        if (!any) in.fail("an arc needs its centre (I, J, K) or its radius (R)");
    }
    words.turns = 1 + block.extra_turns;
    if (in.rules_->motion.turns_by_p && block.words.given('P')) {
        const double turns = block.words.of('P');
        if (!(turns >= 1 && turns <= most_turns) || turns != std::round(turns))
            in.fail("P of an arc must be a whole number of turns, 1 or more");
        words.turns = static_cast<int>(turns);
    }
    refuse_turns(in, block);
    std::string error;
    Arc arc = resolve_arc(words, in.rules_->arc_tolerance_in(in.state_.unit_mm), error);
    if (!error.empty()) in.fail(error, block.words.g_count > 0 ? block.words.g_column[0] : 1);
    const std::optional<ProgramFrame::Circle> circle = in.state_.frame.circle(arc.axis);
    if (!circle) {
        flatten_arc(in, arc, clockwise, words.begin, words.end, rotary_target(in, block));
        return;
    }
    const Vec3 begin = in.state_.frame.to_work(words.begin);
    const Vec3 end = in.state_.frame.to_work(words.end);
    arc.centre = Xyz(in.state_.frame.to_work(arc.centre.vec()));
    arc.axis = static_cast<std::uint8_t>(circle->axis);
    clockwise = clockwise != circle->reversed;
    if (in.compensation_.path.active()) {
        compensated_arc(in, arc, clockwise, end, rotary_target(in, block));
    } else {
        in.push_arc(arc, clockwise, begin, end, rotary_target(in, block));
    }
}

/// A probing move is assumed to touch at its end; the actual contact is known to the machine only. Its stop is exact.
void probe_to(Interpreter& in, const Vec3& end, const Vec3& rotary) {
    for (int axis = 0; axis < 3; ++axis) {
        in.variables_.set(first_probed_parameter + axis, end[axis] / in.state_.unit_mm);
        in.variables_.set(first_probed_parameter + 3 + axis, rotary[axis]);
    }
    in.variables_.set(probe_result_parameter, 0);
    in.event("probe", fmt::format("{:.4f} {:.4f} {:.4f}", end.x(), end.y(), end.z()));
    set_path_mode(in, "path-mode", "probing", {BlockEnd::exact_stop, 0}, true);
    in.straight(MotionKind::feed, end, rotary);
}

}  // namespace

void move_axes(Interpreter& in, const Block& block) {
    const bool turns_tool = take_tool_axis(in, block);
    const bool axes = turns_tool || (block.words.has & (Words::xyz | rotary_axes | other_axes)) != 0 ||
                      block.polar_radius || block.polar_angle ||
                      (in.arcs_.polar_line && (block.words.has & (Words::bit('R') | Words::bit('H'))) != 0);
    settle_spline(in, block);
    switch (in.this_block_.probes ? MotionMode::probe : in.state_.motion) {
        case MotionMode::none:
            if (!axes) return;
            if (in.rules_->motion.needs_mode) in.fail("axis words without a motion mode (G80 is active)");
            in.note(Severity::warning, "program.no-motion-mode", "axis words without a motion mode are read as G1");
            in.state_.motion = MotionMode::feed;
            in.straight(MotionKind::feed, target_of(in, block, in.this_block_.machine_coordinates),
                        rotary_target(in, block));
            return;
        case MotionMode::probe:
            if (axes) probe_to(in, target_of(in, block, in.this_block_.machine_coordinates), rotary_target(in, block));
            return;
        case MotionMode::rapid:
        case MotionMode::feed:
        case MotionMode::thread:
            // RS274 makes a motion of no length from a G0 or G1 without axis words.
            if (!axes && !(in.rules_->motion.moves_without_axes && names_motion(block))) return;
            compensated_straight(in, in.state_.motion == MotionMode::rapid ? MotionKind::rapid : MotionKind::feed,
                                 target_of(in, block, in.this_block_.machine_coordinates), rotary_target(in, block));
            return;
        case MotionMode::tap:
            if (axes) tap(in, target_of(in, block, in.this_block_.machine_coordinates), rotary_target(in, block));
            return;
        case MotionMode::cw:
        case MotionMode::ccw:
            if (axes || (block.words.has & centres) != 0 || !block.named.empty())
                move_on_arc(in, block, in.state_.motion == MotionMode::cw);
            return;
        case MotionMode::cubic_spline:
        case MotionMode::quadratic_spline:
            if (axes) plane_spline(in, block);
            return;
        case MotionMode::nurbs: nurbs_point(in, block); return;
        case MotionMode::knotted_nurbs: knotted_point(in, block); return;
        case MotionMode::akima_spline:
        case MotionMode::basis_spline:
        case MotionMode::point_spline:
            if (axes) spline_point(in, block);
            return;
        case MotionMode::polynomial:
            if (axes || !block.polynomials.empty()) polynomial_span(in, block);
            return;
        case MotionMode::cycle:
            if (axes) drilling_cycle(in, block);
            return;
    }
}

}  // namespace clsurf
