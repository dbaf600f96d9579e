// Turning cycles of LinuxCNC: G70 finishes, G71 and G72 rough a profile given by a subprogram. Rules: LinuxCNC, "G70
// Lathe finishing cycle", "G71 G72 Lathe roughing cycles".

#include "program/interpret/lathe_cycles.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "program/interpret/axis_words.h"
#include "program/interpret/flow.h"
#include "program/interpret/interpreter_state.h"

namespace clsurf {
namespace {

/// Axes of a roughing cut: `feed` (0 z, 1 x) is the cutting direction, `depth` the infeed direction.
struct LatheFrame {
    int feed = 0, depth = 1;
    double onwards = 1;   ///< sign along feed
    double outwards = 1;  ///< sign along depth, from the profile to the start
};

/// The words of a lathe cycle; lengths in mm.
struct LatheCycle {
    int code = 0;  ///< 700: G70
    double distance = 0, step = 0, retract = 0;
    int passes = 1;
};

/// Starts of a roughing cycle, of its cuts and of the contour (z, x) [mm].
struct RoughingStart {
    Vec2 start, front, first;
};

constexpr double coincident = 1e-9;  ///< [mm]
constexpr double no_pocket = 0.01;   ///< permitted roughness of the profile's joints [mm]; a deeper dent is a pocket
constexpr int most_cuts = 100'000;

Vec2 zx(const Vec3& p) { return {p.z(), p.x()}; }

/// The offset profile: `distance` to the left, rounded at outside corners. Empty, with `error` set, if a tool of that
/// radius cannot follow it.
std::vector<CompensatedMove> beside(const Vec2& begin, const std::vector<CompensatedMove>& profile, bool left,
                                    double distance, Vec2& first, std::string& error) {
    first = begin;
    if (distance == 0) return profile;
    CutterCompensation track;
    track.start(left, distance);
    std::vector<CompensatedMove> moves;
    Vec2 from = begin;
    for (const CompensatedMove& move : profile) {
        if (moves.empty()) {
            Vec2 tangent = move.end - from;
            if (move.is_arc) {
                const Vec2 out = from - move.centre;
                tangent = move.counter_clockwise ? Vec2(-out.y(), out.x()) : Vec2(out.y(), -out.x());
            }
            first = track.enter_at_offset(from, tangent.normalized());
        }
        const CompensatedStep step =
            move.is_arc ? track.arc(from, move.end, move.centre, move.counter_clockwise) : track.line(from, move.end);
        error = step.error;
        if (!error.empty()) return {};
        if (step.moves_corner && !moves.empty()) moves.back().end = step.corner;
        moves.insert(moves.end(), step.moves.begin(), step.moves.end());
        from = move.end;
    }
    return moves;
}

/// Where the profile first reaches a depth, in the direction of the cut.
std::optional<double> reach(const Vec2& first, const std::vector<CompensatedMove>& moves, const LatheFrame& frame,
                            double depth) {
    Vec2 from = first;
    for (const CompensatedMove& move : moves) {
        const double a = from[frame.depth];
        const double b = move.end[frame.depth];
        if ((depth - a) * (depth - b) <= coincident * coincident || std::abs(depth - b) < coincident) {
            if (!move.is_arc) {
                const double part = std::abs(b - a) < coincident ? 0.0 : std::clamp((depth - a) / (b - a), 0.0, 1.0);
                return from[frame.feed] + part * (move.end[frame.feed] - from[frame.feed]);
            }
            const double radius = (from - move.centre).norm();
            const double off = depth - move.centre[frame.depth];
            const double half = std::sqrt(std::max(0.0, radius * radius - off * off));
            const double low = std::min(from[frame.feed], move.end[frame.feed]) - coincident;
            const double high = std::max(from[frame.feed], move.end[frame.feed]) + coincident;
            for (const double at :
                 {move.centre[frame.feed] - frame.onwards * half, move.centre[frame.feed] + frame.onwards * half}) {
                if (at >= low && at <= high) return at;
            }
            return move.end[frame.feed];
        }
        from = move.end;
    }
    return std::nullopt;
}

/// Whether the profile always goes onwards and outwards: no pockets.
bool rises(const Vec2& first, const std::vector<CompensatedMove>& moves, const LatheFrame& frame) {
    Vec2 from = first;
    for (const CompensatedMove& move : moves) {
        const Vec2 displacement = move.end - from;
        if (displacement[frame.feed] * frame.onwards < -no_pocket ||
            displacement[frame.depth] * frame.outwards < -no_pocket)
            return false;
        if (move.is_arc) {
            // Monotone arcs stay in one quadrant about their centre.
            const double middle = 0.5 * (angle_of(from - move.centre) + angle_of(move.end - move.centre));
            const Vec2 out = (from - move.centre).norm() * Vec2(std::cos(middle), std::sin(middle));
            const Vec2 half = move.centre + ((out.dot(0.5 * (from + move.end) - move.centre) < 0) ? Vec2(-out) : out);
            for (const int axis : {0, 1}) {
                const double low = std::min(from[axis], move.end[axis]) - no_pocket;
                const double high = std::max(from[axis], move.end[axis]) + no_pocket;
                if (half[axis] < low || half[axis] > high) return false;
            }
        }
        from = move.end;
    }
    return true;
}

/// Runs the profile's subprogram and removes its motions again: the end of the first is the beginning of the profile,
/// the others are its elements.
Vec2 record_profile(Interpreter& in, const std::string& name, std::vector<CompensatedMove>& profile) {
    const ModalState state = in.state_;
    const Block block = in.block_;
    const LineNumber line = in.place_.line;
    const std::string_view current = in.place_.text;
    Motions& m = in.program_.motions;
    const auto first = static_cast<std::size_t>(m.size());
    const std::size_t first_event = in.program_.events.size();
    call_subprogram(in, name, 1, true, {});
    const std::size_t depth = in.calls_.frames.size();
    while (!in.ended_ && in.calls_.frames.size() >= depth) in.run_line();
    in.place_.line = line;
    in.place_.text = current;
    if (m.kind.size() < first + 2) in.fail("the profile has no motion after its first point");
    const Vec2 begin = zx(m.end[first].vec());
    for (std::size_t i = first + 1; i < m.kind.size(); ++i) {
        CompensatedMove move{zx(m.end[i].vec())};
        if (m.kind[i] == MotionKind::spline) in.fail("a profile of a lathe cycle may not have splines");
        if (const Arc* arc = m.arc_of(static_cast<std::int64_t>(i))) {
            move.centre = zx(arc->centre.vec());
            move.is_arc = true;
            move.counter_clockwise = m.kind[i] == MotionKind::ccw;
        }
        const Vec2 from = profile.empty() ? begin : profile.back().end;
        if (move.is_arc || (move.end - from).norm() > coincident) profile.push_back(move);
    }
    m.truncate(static_cast<std::int64_t>(first));
    for (std::size_t i = first_event; i < in.program_.events.size(); ++i) in.program_.events[i].motion = m.size();
    in.state_ = state;
    in.block_ = block;
    in.this_block_.machine_coordinates = false;
    in.this_block_.motion_suppressed = true;  // the axis words of the cycle are its own, not those of a motion
    if (profile.empty()) in.fail("the profile has no length");
    return begin;
}

/// At feed, in the XZ plane.
void follow(Interpreter& in, const std::vector<CompensatedMove>& moves) {
    for (const CompensatedMove& move : moves) {
        const Vec3 end(move.end.y(), in.state_.position.y(), move.end.x());
        if (!move.is_arc) {
            in.straight(MotionKind::feed, end, in.state_.rotary);
            continue;
        }
        Arc arc;
        arc.axis = 1;
        arc.centre = Xyz(move.centre.y(), in.state_.position.y(), move.centre.x());
        in.push_arc(arc, !move.counter_clockwise, in.state_.position, end, in.state_.rotary);
    }
}

LatheCycle lathe_words(const Interpreter& in, const Block& words, int code, std::size_t column) {
    const auto word = [&](char letter, double otherwise) {
        return words.words.given(letter) ? words.words.of(letter) : otherwise;
    };
    const LatheCycle cycle{.code = code,
                           .distance = word('D', 0) * in.state_.unit_mm,
                           .step = word('I', 1) * in.state_.unit_mm,
                           .retract = word('R', 0.5) * in.state_.unit_mm,
                           .passes = static_cast<int>(std::clamp(word('P', 1), 1.0, 1e4))};
    if (!(cycle.distance >= 0)) in.fail("D of a lathe cycle must not be negative", column);
    if (code != 700 && !(cycle.step > 0)) in.fail("I of a roughing cycle must be greater than 0", column);
    return cycle;
}

void go_in_zx(Interpreter& in, const Vec2& to, MotionKind kind = MotionKind::rapid) {
    in.straight(kind, Vec3(to.y(), in.state_.position.y(), to.x()), in.state_.rotary);
}

/// Cuts along the feed, one below the other, then one along the contour `moves`.
void rough(Interpreter& in, const LatheCycle& cycle, const LatheFrame& frame, const RoughingStart& at,
           std::vector<CompensatedMove>& moves, std::size_t column) {
    const auto& [start, front, first] = at;
    if (!rises(first, moves, frame)) {
        in.note(Severity::warning, "program.cycle",
                code_text(cycle.code) + ": the profile has pockets, roughing it is not carried out", column);
        return;
    }
    // Out to the height of the start.
    Vec2 out = moves.back().end;
    if ((start[frame.depth] - out[frame.depth]) * frame.outwards > coincident) {
        out[frame.depth] = start[frame.depth];
        moves.push_back({out});
    }
    const double whole = start[frame.depth] - first[frame.depth];
    if (std::abs(whole) / cycle.step > most_cuts) in.fail("too many cuts: I is too small", column);
    go_in_zx(in, start);
    go_in_zx(in, front);
    for (int cut = 0; cut * cycle.step < std::abs(whole) - coincident; ++cut) {
        const double part = cut * cycle.step / std::abs(whole);
        const Vec2 entry = front + part * (first - front);
        const std::optional<double> end = reach(first, moves, frame, entry[frame.depth]);
        if (!end) continue;
        go_in_zx(in, entry);
        Vec2 to = entry;
        to[frame.feed] = *end;
        go_in_zx(in, to, MotionKind::feed);
        const double off = std::min(cycle.retract, 0.5 * std::abs(*end - entry[frame.feed]));
        to[frame.feed] -= frame.onwards * off;
        to[frame.depth] += frame.outwards * off;
        go_in_zx(in, to);
        to[frame.feed] = entry[frame.feed] + frame.onwards * off;
        go_in_zx(in, to);
        go_in_zx(in, entry);
    }
    go_in_zx(in, first);
    follow(in, moves);
}

}  // namespace

void lathe_cycle(Interpreter& in, int code, const Block& words, std::size_t column) {
    if (in.state_.plane_axis != 1) in.fail(code_text(code) + " needs the XZ plane (G18)", column);
    if (!words.words.given('Q')) in.fail(code_text(code) + " needs its profile's subprogram (Q)", column);
    const LatheCycle cycle = lathe_words(in, words, code, column);
    const Vec3 called_from = target_of(in, words, false);
    std::vector<CompensatedMove> profile;
    const Vec2 begin = record_profile(in, fmt::format("{}", std::lround(words.words.of('Q'))), profile);

    LatheFrame frame;
    if (code >= 720) std::swap(frame.feed, frame.depth);
    const Vec2 start = zx(called_from);
    double onwards = profile.back().end[frame.feed] - begin[frame.feed];
    if (std::abs(onwards) < coincident) onwards = begin[frame.feed] - start[frame.feed];
    frame.onwards = onwards < 0 ? -1 : 1;
    frame.outwards = start[frame.depth] < begin[frame.depth] ? -1 : 1;
    const bool left = (frame.feed == 0) == (frame.onwards * frame.outwards > 0);
    // If the start is beyond the profile's begin, cuts begin at the profile.
    Vec2 front = start;
    if ((begin[frame.feed] - start[frame.feed]) * frame.onwards < 0) front[frame.feed] = begin[frame.feed];
    const auto contour = [&](double off, Vec2& first) {
        std::string error;
        std::vector<CompensatedMove> moves = beside(begin, profile, left, off, first, error);
        if (!error.empty()) in.fail(error, column);
        return moves;
    };
    Vec2 first;
    if (code != 700) {
        std::vector<CompensatedMove> moves = contour(cycle.distance, first);
        rough(in, cycle, frame, {start, front, first}, moves, column);
        return;
    }
    go_in_zx(in, start);
    for (int pass = cycle.passes - 1; pass >= 0; --pass) {
        const std::vector<CompensatedMove> moves = contour(cycle.distance * pass / cycle.passes, first);
        go_in_zx(in, front);
        go_in_zx(in, first);
        follow(in, moves);
    }
}

}  // namespace clsurf
