// Blocks that move: targets, lines, arcs.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/geometry.h"
#include "core/units.h"
#include "program/feed_mode_cursor.h"
#include "program/interpret/interpreter_state.h"

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

}  // namespace

Vec3 Interpreter::target(const Block& block, bool machine) {
    return machine ? state_.from_machine(read_axes(block, true)) : state_.frame.to_work(read_axes(block, false));
}

/// The axis words in machine or in programmed coordinates.
Vec3 Interpreter::read_axes(const Block& block, bool machine) {
    Vec3 base = machine ? state_.to_machine(state_.position) : state_.programmed();
    constexpr unsigned all = WorkFrame::all_axes;
    const unsigned plane = all & ~(1u << state_.plane_axis);
    const bool by_pole =
        frames_.polar.on || arcs_.polar_line || block.polar_radius || block.polar_angle || ends_by_angle(block);
    // A frame's turn mixes the axes.
    const bool mixed = !machine && state_.frame.active() && axes_named(block.words) != 0;
    state_.place(mixed ? all : axes_named(block.words) | (by_pole && !machine ? plane : 0u), machine);
    if ((frames_.polar.on || arcs_.polar_line) && !machine) {
        if (rules_->about_pole != nullptr) rules_->about_pole(*this, block, base);
        return base;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const char letter = "XYZ"[axis];
        if (!block.words.given(letter)) continue;
        const double value = block.words.of(letter) * state_.unit_mm * (axis == 0 && state_.diameter ? 0.5 : 1.0);
        const std::uint32_t bit = Words::bit(letter);
        const bool incremental =
            !machine && (state_.incremental ? (block.absolute & bit) == 0 : (block.incremental & bit) != 0);
        // Before the first motion an increment counts from the control's own zero.
        const double from = std::isnan(base[axis]) ? 0.0 : base[axis];
        base[axis] = incremental ? from + value : value;
    }
    if (ends_by_angle(block)) end_by_angle(block, base);
    if (block.polar_radius || block.polar_angle) {
        if (rules_->about_pole != nullptr)
            rules_->about_pole(*this, block, base);
        else
            put_polar(block, base);
    }
    return base;
}

/// The axis of the plane's normal, beside polar words.
void Interpreter::straight_to_pole_plane(const Block& block, const Vec3& from, Vec3& end) const {
    const int k = state_.plane_axis;
    const char letter = "XYZ"[k];
    if (!block.words.given(letter)) return;
    const std::uint32_t bit = Words::bit(letter);
    const bool adds = state_.incremental ? (block.absolute & bit) == 0 : (block.incremental & bit) != 0;
    end[k] = (adds ? from[k] : 0.0) + block.words.of(letter) * state_.unit_mm;
}

void Interpreter::put_at_pole(Vec3& end) const {
    const int u = (state_.plane_axis + 1) % 3;
    const int v = (state_.plane_axis + 2) % 3;
    end[u] = frames_.polar.pole[u] + frames_.polar.radius * std::cos(frames_.polar.angle * rad_per_deg);
    end[v] = frames_.polar.pole[v] + frames_.polar.radius * std::sin(frames_.polar.angle * rad_per_deg);
}

/// The end of a motion by radius [programmed lengths] and angle [deg] about the pole; what is not given stays as it is.
void Interpreter::put_about_pole(std::optional<double> radius, std::optional<double> angle, bool radius_adds,
                                 bool angle_adds, Vec3& end) {
    const int u = (state_.plane_axis + 1) % 3;
    const int v = (state_.plane_axis + 2) % 3;
    const Vec3 from = end.array().isNaN().select(0.0, end);
    const Vec2 now(from[u] - frames_.polar.pole[u], from[v] - frames_.polar.pole[v]);
    frames_.polar.radius = radius ? *radius * state_.unit_mm + (radius_adds ? now.norm() : 0.0) : now.norm();
    const double angle_now = angle_of(now) * deg_per_rad;
    frames_.polar.angle = angle ? *angle + (angle_adds ? angle_now : 0.0) : angle_now;
    put_at_pole(end);
}

/// LinuxCNC's polar words: @ radius, ^ angle about the work origin.
void Interpreter::put_polar(const Block& block, Vec3& end) const {
    if (block.words.given('X') || block.words.given('Y')) fail("polar words (@, ^) cannot be combined with X or Y");
    if (state_.plane_axis != 2) fail("polar words (@, ^) need the XY plane (G17)");
    const Vec2 from(end.x(), end.y());
    const double radius_now = from.norm();
    if (radius_now == 0 && (state_.incremental || !block.polar_angle))
        fail("polar words (@, ^) at the origin: the angle is not known");
    const double angle_now = angle_of(from);
    double radius = radius_now;
    double angle = angle_now;
    if (block.polar_radius) radius = (state_.incremental ? radius_now : 0.0) + *block.polar_radius * state_.unit_mm;
    if (block.polar_angle) angle = (state_.incremental ? angle_now : 0.0) + *block.polar_angle * rad_per_deg;
    end.x() = radius * std::cos(angle);
    end.y() = radius * std::sin(angle);
}

/// The whole turns [deg] that are added to an absolute position of a modulo axis [deg], which stands at `from` [deg].
/// SINUMERIK Function Manual Axes and Spindles, R2: DC turns by 180° at most, and by 180° in positive direction; ACP and ACN
/// turn by less than 360°; without them the axis stays in its turn.
double Interpreter::whole_turns(const Block& block, std::uint32_t bit, double position, double from) {
    constexpr double turn = 360;
    constexpr double same_angle = 1e-9;  // [deg] of rounding
    const double turns = (from - position) / turn;
    const double rounding = same_angle / turn;
    if ((block.shortest & bit) != 0) return turn * std::floor(turns + 0.5 + rounding);
    if ((block.positive & bit) != 0) return turn * std::ceil(turns - rounding);
    if ((block.negative & bit) != 0) return turn * std::floor(turns + rounding);
    return turn * std::floor(from / turn + rounding);
}

Vec3 Interpreter::rotary_target(const Block& block) {
    const bool machine = this_block_.machine_coordinates && rules_->motion.rotary_in_machine;
    Vec3 target = state_.rotary;
    for (int axis = 0; axis < 3; ++axis) {
        const char letter = "ABC"[axis];
        if (!block.words.given(letter)) continue;
        const std::uint32_t bit = Words::bit(letter);
        if (((block.shortest | block.positive | block.negative) & bit) != 0)
            state_.modulo = static_cast<std::uint8_t>(state_.modulo | 1u << axis);
        if (machine) {
            target[axis] = block.words.of(letter) - state_.rotary_offset()[axis];
            continue;
        }
        const bool incremental = state_.incremental ? (block.absolute & bit) == 0 : (block.incremental & bit) != 0;
        if (incremental && std::isnan(target[axis])) {
            fail(fmt::format("an increment of {}: its angle is not known after a tool axis given as a vector", letter),
                 block.words.column[static_cast<std::size_t>(letter - 'A')]);
        }
        const double from = target[axis];
        target[axis] = (incremental ? from : 0.0) + block.words.of(letter);
        // After a tool axis given as a vector the turn is not known.
        if (!incremental && (state_.modulo >> axis & 1) != 0 && !std::isnan(from))
            target[axis] += whole_turns(block, bit, target[axis], from);
    }
    return target;
}

void Interpreter::move(const Block& block) {
    const bool turns_tool = take_tool_axis(block);
    const bool axes = turns_tool || (block.words.has & (Words::xyz | rotary_axes | other_axes)) != 0 ||
                      block.polar_radius || block.polar_angle ||
                      (arcs_.polar_line && (block.words.has & (Words::bit('R') | Words::bit('H'))) != 0);
    settle_spline(block);
    switch (this_block_.probes ? MotionMode::probe : state_.motion) {
        case MotionMode::none:
            if (!axes) return;
            if (rules_->motion.needs_mode) fail("axis words without a motion mode (G80 is active)");
            note(Severity::warning, "program.no-motion-mode", "axis words without a motion mode are read as G1");
            state_.motion = MotionMode::feed;
            straight(MotionKind::feed, target(block, this_block_.machine_coordinates), rotary_target(block));
            return;
        case MotionMode::probe:
            if (axes) probe(target(block, this_block_.machine_coordinates), rotary_target(block));
            return;
        case MotionMode::rapid:
        case MotionMode::feed:
        case MotionMode::thread:
            // RS274 makes a motion of no length of a G0 or G1 that stands alone.
            if (!axes && !(rules_->motion.moves_without_axes && names_motion(block))) return;
            compensated_straight(state_.motion == MotionMode::rapid ? MotionKind::rapid : MotionKind::feed,
                                 target(block, this_block_.machine_coordinates), rotary_target(block));
            return;
        case MotionMode::tap:
            if (axes) tap(target(block, this_block_.machine_coordinates), rotary_target(block));
            return;
        case MotionMode::cw:
        case MotionMode::ccw:
            if (axes || (block.words.has & centres) != 0 || !block.named.empty())
                arc(block, state_.motion == MotionMode::cw);
            return;
        case MotionMode::cubic_spline:
        case MotionMode::quadratic_spline:
            if (axes) spline(block);
            return;
        case MotionMode::nurbs: nurbs_point(block); return;
        case MotionMode::knotted_nurbs: knotted_point(block); return;
        case MotionMode::akima_spline:
        case MotionMode::basis_spline:
        case MotionMode::point_spline:
            if (axes) spline_point(block);
            return;
        case MotionMode::polynomial:
            if (axes || !block.polynomials.empty()) polynomial(block);
            return;
        case MotionMode::cycle:
            if (axes) cycle(block);
            return;
    }
}

void Interpreter::select_feed_mode(FeedMode mode) {
    if (mode == state_.feed_mode) return;
    state_.feed_mode = mode;
    const bool per_minute = mode == FeedMode::per_minute;
    event(std::string(feed_mode_event), per_minute                       ? std::string(feed_per_minute)
                                        : mode == FeedMode::inverse_time ? std::string(feed_inverse_time)
                                                                         : "G95");
}

/// `unit`: what F counts in, mm of a length, or 1 of a turn in degrees, where inches do not count.
float Interpreter::feed_for(double length, double unit) {
    switch (state_.feed_mode) {
        case FeedMode::inverse_time:
            // What moves nothing takes no time: any feed will do, but none.
            if (length > 0) return static_cast<float>(length * state_.feed / seconds_per_minute);
            [[fallthrough]];
        case FeedMode::per_minute: return static_cast<float>(state_.feed * unit / seconds_per_minute);
        case FeedMode::per_revolution:
            return static_cast<float>(state_.feed * unit * state_.spindle / seconds_per_minute);
    }
    return 0;
}

/// How far the rotary axes turn together, or the tool axis where it is a vector [deg].
double Interpreter::turn_to(const Vec3& rotary) const {
    const auto known = [](const Vec3& turn) { return Vec3(turn.array().isNaN().select(0.0, turn)); };
    if (!tool_axis_is_vector()) return known(rotary - state_.rotary).norm();
    const Column<Xyz>& axes = program_.motions.tool_axis;
    return axes.empty() ? 0 : angle_between(known(axes.back().vec()), state_.tool_axis) / rad_per_deg;
}

void Interpreter::straight(MotionKind kind, const Vec3& end, const Vec3& rotary) {
    const Vec3 from = state_.position.array().isNaN().select(end, state_.position);
    const double length = (end - from).norm(), turn = length > 0 ? 0 : turn_to(rotary);
    const float feed = kind == MotionKind::rapid ? std::numeric_limits<float>::quiet_NaN()
                       : turn > 0                ? feed_for(turn, 1)
                                                 : feed_for(length);
    push(kind, end, rotary, feed);
}

void Interpreter::arc(const Block& block, bool clockwise) {
    if (compensation_.ended_at == program_.motions.size())
        fail("the first motion after cutter compensation (G40) must be a straight one");
    ArcWords words;
    // In programmed coordinates; the frame takes the arc as a whole.
    words.begin = state_.programmed();
    words.begin = words.begin.array().isNaN().select(0.0, words.begin);
    words.end =
        this_block_.machine_coordinates ? state_.frame.to_programmed(target(block, true)) : read_axes(block, false);
    words.end = words.end.array().isNaN().select(words.begin, words.end);
    words.axis = state_.plane_axis;
    words.clockwise = clockwise;
    if (rules_->arc != nullptr && rules_->arc(*this, block, words)) {
        clockwise = words.clockwise;
    } else if (block.words.given('R')) {
        words.has_radius = true;
        words.radius = block.words.of('R') * state_.unit_mm;
    } else {
        words.centre = words.begin;
        bool any = false;
        for (int k = 0; k < 3; ++k) {
            const char letter = "IJK"[k];
            if (k == words.axis || !block.words.given(letter)) continue;
            any = true;
            const std::uint32_t bit = Words::bit(letter);
            const bool absolute = state_.centre_absolute || (block.absolute & bit) != 0;
            const double value = block.words.of(letter) * state_.unit_mm;
            words.centre[k] = absolute ? value : words.begin[k] + value;
        }
        if (!any) fail("an arc needs its centre (I, J, K) or its radius (R)");
    }
    words.turns = 1 + block.extra_turns;
    if (rules_->motion.turns_by_p && block.words.given('P')) {
        const double turns = block.words.of('P');
        if (!(turns >= 1 && turns <= most_turns) || turns != std::round(turns))
            fail("P of an arc must be a whole number of turns, 1 or more");
        words.turns = static_cast<int>(turns);
    }
    refuse_turns(block);
    std::string error;
    Arc arc = resolve_arc(words, rules_->arc_tolerance_in(state_.unit_mm), error);
    if (!error.empty()) fail(error, block.words.g_count > 0 ? block.words.g_column[0] : 1);
    const std::optional<ProgramFrame::Circle> circle = state_.frame.circle(arc.axis);
    if (!circle) {
        flatten_arc(arc, clockwise, words.begin, words.end, rotary_target(block));
        return;
    }
    const Vec3 begin = state_.frame.to_work(words.begin);
    const Vec3 end = state_.frame.to_work(words.end);
    arc.centre = Xyz(state_.frame.to_work(arc.centre.vec()));
    arc.axis = static_cast<std::uint8_t>(circle->axis);
    clockwise = clockwise != circle->reversed;
    if (compensation_.path.active()) {
        compensated_arc(arc, clockwise, end, rotary_target(block));
    } else {
        push_arc(arc, clockwise, begin, end, rotary_target(block));
    }
}

/// Turns as another dialect gives them, or as a spiral: P, L and Q beside an arc.
void Interpreter::refuse_turns(const Block& block) const {
    if (block.words.m_count > 0) return;
    for (const RefusedLetter& row : rules_->motion.refused_at_arcs) {
        if (!block.words.given(row.letter)) continue;
        fail(fmt::format("{} in a block with an arc is not known in {}", row.letter, program_.dialect->name),
             block.words.column[static_cast<std::size_t>(row.letter - 'A')], row.hint);
    }
}

/// An arc that its frame makes an ellipse, or tilts out of the principal planes.
void Interpreter::flatten_arc(const Arc& arc, bool clockwise, const Vec3& begin, const Vec3& end, const Vec3& rotary) {
    if (compensation_.path.on())
        fail("cutter compensation of an arc in a tilted or unevenly scaled frame is not supported");
    // The frame may stretch the chords' error.
    const Vec3 u = state_.frame.direction_to_work(Vec3::Unit((arc.axis + 1) % 3));
    const Vec3 v = state_.frame.direction_to_work(Vec3::Unit((arc.axis + 2) % 3));
    const double stretch = std::max(1.0, std::hypot(u.norm(), v.norm()));
    const std::vector<Vec3> chords = arc_chords(arc, clockwise, begin, end, arc_chord_error / stretch);
    const Vec3 turned_from = state_.rotary;
    for (std::size_t k = 0; k < chords.size(); ++k) {
        const double part = static_cast<double>(k + 1) / static_cast<double>(chords.size());
        straight(MotionKind::spline, state_.frame.to_work(chords[k]), turned_from + part * (rotary - turned_from));
    }
}

void Interpreter::push_arc(Arc arc, bool clockwise, const Vec3& begin, const Vec3& end, const Vec3& rotary) {
    if (curves_.is_open()) {
        // The spline ends in the direction in which the arc begins.
        Vec3 out = begin - arc.centre.vec();
        out[arc.axis] = 0;
        const Vec3 axis = Vec3::Unit(arc.axis);
        close_spline(clockwise ? out.cross(axis) : axis.cross(out));
    }
    arc.motion = program_.motions.size();
    program_.motions.arcs.push_back(arc);
    push(clockwise ? MotionKind::cw : MotionKind::ccw, end, rotary, feed_for(arc_length(arc, clockwise, begin, end)));
}

/// A probing move is taken to touch at its end: where it really does, only the machine knows. Its stop is exact.
void Interpreter::probe(const Vec3& end, const Vec3& rotary) {
    for (int axis = 0; axis < 3; ++axis) {
        variables_.set(first_probed_parameter + axis, end[axis] / state_.unit_mm);
        variables_.set(first_probed_parameter + 3 + axis, rotary[axis]);
    }
    variables_.set(probe_result_parameter, 0);
    event("probe", fmt::format("{:.4f} {:.4f} {:.4f}", end.x(), end.y(), end.z()));
    set_path_mode("path-mode", "probing", {BlockEnd::exact_stop, 0}, true);
    straight(MotionKind::feed, end, rotary);
}

void Interpreter::push(MotionKind kind, const Vec3& end, const Vec3& rotary, float feed) {
    if (curves_.is_open()) close_spline_before(end);
    Motions& m = program_.motions;
    if (forgotten_ + m.kind.size() >= most_motions_)
        fail(fmt::format("more than {} motions from {} lines: an endless loop?", most_motions_,
                         program_.main().line_count()));
    if (end.array().isInf().any()) fail("a position is not finite");
    if (feed == 0 && kind != MotionKind::dwell && !feed_missed_) {
        feed_missed_ = true;
        note(Severity::warning, "program.no-feed",
             state_.feed == 0 ? "a cutting motion without feed (F); reported once"
                              : "a cutting motion with a feed of 0 (is the spindle speed missing?); reported once");
    }
    m.kind.push_back(kind);
    m.end.push_back(Xyz(end));
    m.feed.push_back(feed);
    m.line.push_back(place_.line);
    if (state_.frame_changes != work_frames_.changes || state_.held != work_frames_.held ||
        state_.absolute != work_frames_.absolute || state_.frame != work_frames_.words)
        settle_work_frame();
    for (unsigned axis = 0; state_.unplaced != 0 && axis < 3; ++axis) {
        if ((state_.unplaced >> axis & 1) != 0) m.programmed_from[axis] = m.size();
    }
    if (work_frames_.current != 0 || !m.frame.empty()) {
        if (m.frame.empty()) m.frame = Column<std::uint32_t>(m.kind.size() - 1, 0);
        m.frame.push_back(work_frames_.current);
    }
    const bool vector = tool_axis_is_vector();
    const Vec3 angles = vector ? Vec3(Vec3::Constant(std::numeric_limits<double>::quiet_NaN())) : rotary;
    if (!m.rotary.empty() || angles.squaredNorm() != 0) {
        if (m.rotary.empty()) m.rotary = Column<Xyz>(m.kind.size() - 1, Xyz(0, 0, 0));
        m.rotary.push_back(Xyz(angles * rad_per_deg));
    }
    if (vector || !m.tool_axis.empty()) {
        const Xyz none(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
        if (m.tool_axis.empty()) m.tool_axis = Column<Xyz>(m.kind.size() - 1, none);
        m.tool_axis.push_back(vector ? Xyz(state_.tool_axis) : none);
    }
    if (!m.file.empty() || place_.file != 0) {
        if (m.file.empty()) m.file = Column<std::uint16_t>(m.kind.size() - 1, 0);
        m.file.push_back(static_cast<std::uint16_t>(place_.file));
    }
    if (!m.calls.empty()) {
        if (m.call.empty()) m.call = Column<std::uint32_t>(m.kind.size() - 1, 0);
        m.call.push_back(calls_.running);
    }
    arcs_.begin_of_last = state_.position;
    state_.position = end;
    state_.rotary = angles;
}

}  // namespace clsurf
