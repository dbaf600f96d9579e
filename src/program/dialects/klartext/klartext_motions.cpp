// Blocks of Klartext that move: lines, arcs, polar words, corners cut by RND and CHF.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "program/dialects/klartext/klartext.h"
#include "program/interpret/axis_words.h"
#include "program/interpret/tilted_plane.h"

namespace clsurf::klartext {
namespace {

constexpr double least_angle = 1e-9;  ///< [rad] least angle between lines that form a corner
constexpr double same_height = 1e-9;  ///< [mm]

/// The beginning and end of the corner's arc or chamfer, in the plane of the axes u and v.
struct CutCorner {
    Vec3 begin, end, centre;
    bool clockwise = false;
};

CutCorner cut(Interpreter& in, const Vec3& before, const Vec3& corner, const Vec3& after) {
    const int axis = in.state_.plane_axis;
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const Vec3 back = before - corner;
    const Vec3 on = after - corner;
    if (!(std::abs(back[axis]) <= same_height && std::abs(on[axis]) <= same_height))
        in.fail("RND and CHF are read where both lines lie in the working plane");
    const double angle = std::atan2(std::abs(back[u] * on[v] - back[v] * on[u]), back.dot(on));
    const double turn = back[v] * on[u] - back[u] * on[v];  // left: positive
    CutCorner result;
    result.begin = result.end = result.centre = corner;
    if (!(angle > least_angle && angle < std::numbers::pi - least_angle)) return result;
    const double size = state_of(in).corner.size;
    const double setback = state_of(in).corner.rounded ? size / std::tan(angle / 2) : size;
    if (!(setback <= back.norm() && setback <= on.norm()))
        in.fail(fmt::format("{} {:g} does not fit between its lines", state_of(in).corner.rounded ? "RND R" : "CHF",
                            size / in.state_.unit_mm));
    const Vec3 first = back.normalized();
    const Vec3 second = on.normalized();
    result.begin = corner + setback * first;
    result.end = corner + setback * second;
    result.centre = corner + size / std::sin(angle / 2) * (first + second).normalized();
    result.clockwise = turn < 0;
    return result;
}

/// Moves the end of the last line back to the beginning of the cut corner, and cuts it.
void finish_corner(Line& line, const KlartextWords& words, const Block& block) {
    Interpreter& in = line.in;
    const Corner corner = state_of(in).corner;
    const std::optional<ProgramFrame::Circle> circle = in.state_.frame.circle(in.state_.plane_axis);
    if (!circle || circle->axis != in.state_.plane_axis)
        in.fail("RND and CHF in a tilted or unevenly scaled frame are not supported");
    if (words.feed == KlartextFeed::rapid) in.fail("a line with feed must follow RND and CHF", line.start + 1);
    const Vec3 after = target_of(in, block, false);
    const CutCorner shape = cut(in, in.arcs_.begin_of_last, in.state_.position, after);
    state_of(in).corner.pending = false;
    if (shape.begin == shape.end) return;
    in.program_.motions.end.back() = Xyz(shape.begin);
    in.state_.position = shape.begin;
    const double feed = std::exchange(in.state_.feed, corner.feed);
    const LineNumber here = std::exchange(in.place_.line, corner.line);
    if (corner.rounded) {
        Arc arc;
        arc.centre = Xyz(shape.centre);
        arc.axis = static_cast<std::uint8_t>(in.state_.plane_axis);
        in.push_arc(arc, shape.clockwise, shape.begin, shape.end, in.state_.rotary);
    } else {
        in.straight(MotionKind::feed, shape.end, in.state_.rotary);
    }
    in.place_.line = here;
    in.state_.feed = feed;
}

/// The words of a block in the interpreter's own form.
void fill(Line& line, const KlartextWords& words, Block& block) {
    Interpreter& in = line.in;
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 3> axes{
        {{"TX", "A3"}, {"TY", "B3"}, {"TZ", "C3"}}};
    for (const auto& [name, word] : words.values) {
        if (name == "PR") {
            block.polar_radius = word.value;
            block.polar_radius_incremental = word.incremental;
        } else if (name == "PA") {
            block.polar_angle = word.value;
            block.polar_angle_incremental = word.incremental;
        } else if (name.size() == 1) {
            block.words.set(name[0], word.value, word.column);
            if (word.incremental) block.incremental |= Words::bit(name[0]);
        }
        for (const auto& [vector, axis] : axes) {
            if (name == vector) block.named.push_back({std::string(axis), word.value, word.column, {}});
        }
    }
    if (words.feed == KlartextFeed::number) in.state_.feed = words.feed_value;
    if (words.feed == KlartextFeed::automatic) in.state_.feed = state_of(in).tool_feed;
    for (const int m : words.m) (void)add_m(block.words, m);
    if (words.side == KlartextSide::unchanged || words.side == state_of(in).side) return;
    state_of(in).side = words.side;
    (void)add_g(block.words,
                words.side == KlartextSide::none   ? 40
                : words.side == KlartextSide::left ? 41
                                                   : 42,
                line.start + 1);
}

/// M140 MB50: retracts along the tool axis. The distance of MB MAX is known to the machine only.
void retract(Line& line, const KlartextValue& distance) {
    Interpreter& in = line.in;
    if (!std::isfinite(distance.value)) {
        in.note(Severity::warning, "program.retract",
                "M140 MB MAX goes to the end of the travel, which is not known: no motion is read", distance.column);
        return;
    }
    Vec3 axis = in.state_.tool_axis;
    if (axis.hasNaN()) axis = in.state_.frame.direction_to_work(Vec3::Unit(in.state_.plane_axis)).normalized();
    in.straight(MotionKind::feed, in.state_.position + distance.value * in.state_.unit_mm * axis, in.state_.rotary);
}

}  // namespace

bool takes_corner(std::string_view name) { return name == "L" || name == "LP"; }

void move_with(Line& line, const KlartextWords& words, int code) {
    Interpreter& in = line.in;
    Block& block = in.block_;
    block.clear();
    const int g = code / 10;  // codes are in tenths
    (void)add_g(block.words, g, line.start + 1);
    fill(line, words, block);
    if (words.reads_plane_angles && in.five_axis_.tilted) {
        // The angles computed by PLANE: the tool is normal to the plane.
        block.words.has &= ~(Words::bit('A') | Words::bit('B') | Words::bit('C'));
        turn_to_plane(in, in.state_.frame.direction_to_work(Vec3::UnitZ()).normalized(), false, "PLANE");
    }
    if (state_of(in).corner.pending) finish_corner(line, words, block);
    in.execute(block);
    if (words.retract) retract(line, *words.retract);
}

void straight(Line& line, const KlartextWords& words) {
    line.in.arcs_.kind = ArcKind::usual;
    move_with(line, words, words.feed == KlartextFeed::rapid ? 0_g : 1_g);
}

void arc(Line& line, const KlartextWords& words, ArcKind kind) {
    Interpreter& in = line.in;
    if (words.feed == KlartextFeed::rapid) in.fail("FMAX of an arc is not supported", line.start + 1);
    if (kind == ArcKind::by_radius && words.find("R") == nullptr) in.fail("CR needs its radius (R)", line.start + 1);
    in.arcs_.kind = kind;
    const bool clockwise = words.clockwise.value_or(in.arcs_.last_clockwise);
    Block& block = in.block_;
    block.clear();
    (void)add_g(block.words, clockwise ? 2 : 3, line.start + 1);
    fill(line, words, block);
    if (const KlartextValue* angle = words.find("PA"); angle != nullptr && angle->incremental) {
        constexpr double full_circle = 360;
        constexpr double most_degrees = 1e6;
        if (words.clockwise && angle->value != 0 && (angle->value < 0) != clockwise)
            in.fail("IPA and DR must have the same sign", angle->column);
        const double turned = std::min(std::abs(angle->value), most_degrees) / full_circle;
        block.extra_turns = std::max(0, static_cast<int>(std::ceil(turned - least_angle)) - 1);
    }
    in.execute(block);
    in.arcs_.last_clockwise = clockwise;
}

std::string Line::quoted() {
    const std::size_t end = c.peek() == '"' ? c.text.find('"', c.at + 1) : std::string_view::npos;
    if (end == std::string_view::npos) throw ReadError{"expected a name between quotes", c.column(), {}};
    std::string name(c.text.substr(c.at + 1, end - c.at - 1));
    c.at = end + 1;
    return name;
}

}  // namespace clsurf::klartext
