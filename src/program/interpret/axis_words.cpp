#include "program/interpret/axis_words.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/units.h"
#include "program/interpret/interpreter_state.h"

namespace clsurf {
namespace {

/// LinuxCNC's polar words: @ radius, ^ angle about the work origin.
void put_polar(const Interpreter& in, const Block& block, Vec3& end) {
    if (block.words.given('X') || block.words.given('Y')) in.fail("polar words (@, ^) cannot be combined with X or Y");
    if (in.state_.plane_axis != 2) in.fail("polar words (@, ^) need the XY plane (G17)");
    const Vec2 from(end.x(), end.y());
    const double radius_now = from.norm();
    if (radius_now == 0 && (in.state_.incremental || !block.polar_angle))
        in.fail("polar words (@, ^) at the origin: the angle is not known");
    const double angle_now = angle_of(from);
    double radius = radius_now;
    double angle = angle_now;
    if (block.polar_radius)
        radius = (in.state_.incremental ? radius_now : 0.0) + *block.polar_radius * in.state_.unit_mm;
    if (block.polar_angle) angle = (in.state_.incremental ? angle_now : 0.0) + *block.polar_angle * rad_per_deg;
    end.x() = radius * std::cos(angle);
    end.y() = radius * std::sin(angle);
}

/// The whole turns [deg] that are added to an absolute position of a modulo axis [deg] at `from` [deg]. SINUMERIK Function
/// Manual Axes and Spindles, R2: DC turns by at most 180°, and by 180° in positive direction; ACP and ACN turn by less than
/// 360°; without them the axis stays within its turn.
double whole_turns(const Block& block, std::uint32_t bit, double position, double from) {
    constexpr double turn = 360;
    constexpr double same_angle = 1e-9;  // [deg] of rounding
    const double turns = (from - position) / turn;
    const double rounding = same_angle / turn;
    if ((block.shortest & bit) != 0) return turn * std::floor(turns + 0.5 + rounding);
    if ((block.positive & bit) != 0) return turn * std::ceil(turns - rounding);
    if ((block.negative & bit) != 0) return turn * std::floor(turns + rounding);
    return turn * std::floor(from / turn + rounding);
}

void end_by_angle(const Interpreter& in, const Block& block, Vec3& end) {
    const int u = (in.state_.plane_axis + 1) % 3;
    const int v = (in.state_.plane_axis + 2) % 3;
    const NamedWord& angle = *block.find("ANG");
    const Vec3 from = in.state_.programmed().array().isNaN().select(0.0, in.state_.programmed());
    const Vec2 displacement(std::cos(angle.value * rad_per_deg), std::sin(angle.value * rad_per_deg));
    const bool along = block.words.given("XYZ"[u]);
    const double given = along ? displacement.x() : displacement.y();
    if (std::abs(given) < 1e-9)
        in.fail(fmt::format("a line at ANG={:g} does not reach the given {}", angle.value, "XYZ"[along ? u : v]),
                angle.column);
    if (along)
        end[v] = from[v] + (end[u] - from[u]) * displacement.y() / displacement.x();
    else
        end[u] = from[u] + (end[v] - from[v]) * displacement.x() / displacement.y();
}

}  // namespace

Vec3 target_of(Interpreter& in, const Block& block, bool machine) {
    return machine ? in.state_.from_machine(read_axes(in, block, true))
                   : in.state_.frame.to_work(read_axes(in, block, false));
}

Vec3 read_axes(Interpreter& in, const Block& block, bool machine) {
    Vec3 base = machine ? in.state_.to_machine(in.state_.position) : in.state_.programmed();
    constexpr unsigned all = WorkFrame::all_axes;
    const unsigned plane = all & ~(1u << in.state_.plane_axis);
    const bool by_pole = in.polar_.on || in.arcs_.polar_line || block.polar_radius || block.polar_angle ||
                         ends_by_angle(in.state_, block);
    // The rotation of a frame mixes the axes.
    const bool mixed = !machine && in.state_.frame.active() && axes_named(block.words) != 0;
    in.state_.place(mixed ? all : axes_named(block.words) | (by_pole && !machine ? plane : 0u), machine);
    if ((in.polar_.on || in.arcs_.polar_line) && !machine) {
        if (in.rules_->about_pole != nullptr) in.rules_->about_pole(in, block, base);
        return base;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const char letter = "XYZ"[axis];
        if (!block.words.given(letter)) continue;
        const double value = block.words.of(letter) * in.state_.unit_mm * (axis == 0 && in.state_.diameter ? 0.5 : 1.0);
        const std::uint32_t bit = Words::bit(letter);
        const bool incremental =
            !machine && (in.state_.incremental ? (block.absolute & bit) == 0 : (block.incremental & bit) != 0);
        // Before the first motion an increment counts from the control's own zero.
        const double from = std::isnan(base[axis]) ? 0.0 : base[axis];
        base[axis] = incremental ? from + value : value;
    }
    if (ends_by_angle(in.state_, block)) end_by_angle(in, block, base);
    if (block.polar_radius || block.polar_angle) {
        if (in.rules_->about_pole != nullptr)
            in.rules_->about_pole(in, block, base);
        else
            put_polar(in, block, base);
    }
    return base;
}

void straight_to_pole_plane(const ModalState& state, const Block& block, const Vec3& from, Vec3& end) {
    const int k = state.plane_axis;
    const char letter = "XYZ"[k];
    if (!block.words.given(letter)) return;
    const std::uint32_t bit = Words::bit(letter);
    const bool adds = state.incremental ? (block.absolute & bit) == 0 : (block.incremental & bit) != 0;
    end[k] = (adds ? from[k] : 0.0) + block.words.of(letter) * state.unit_mm;
}

void put_at_pole(const PolarState& polar, int plane_axis, Vec3& end) {
    const int u = (plane_axis + 1) % 3;
    const int v = (plane_axis + 2) % 3;
    end[u] = polar.pole[u] + polar.radius * std::cos(polar.angle * rad_per_deg);
    end[v] = polar.pole[v] + polar.radius * std::sin(polar.angle * rad_per_deg);
}

void put_about_pole(PolarState& polar, const ModalState& state, std::optional<double> radius,
                    std::optional<double> angle, bool radius_adds, bool angle_adds, Vec3& end) {
    const int u = (state.plane_axis + 1) % 3;
    const int v = (state.plane_axis + 2) % 3;
    const Vec3 from = end.array().isNaN().select(0.0, end);
    const Vec2 now(from[u] - polar.pole[u], from[v] - polar.pole[v]);
    polar.radius = radius ? *radius * state.unit_mm + (radius_adds ? now.norm() : 0.0) : now.norm();
    const double angle_now = angle_of(now) * deg_per_rad;
    polar.angle = angle ? *angle + (angle_adds ? angle_now : 0.0) : angle_now;
    put_at_pole(polar, state.plane_axis, end);
}

Vec3 rotary_target(Interpreter& in, const Block& block) {
    const bool machine = in.this_block_.machine_coordinates && in.rules_->motion.rotary_in_machine;
    Vec3 target = in.state_.rotary;
    for (int axis = 0; axis < 3; ++axis) {
        const char letter = "ABC"[axis];
        if (!block.words.given(letter)) continue;
        const std::uint32_t bit = Words::bit(letter);
        if (((block.shortest | block.positive | block.negative) & bit) != 0)
            in.state_.modulo = static_cast<std::uint8_t>(in.state_.modulo | 1u << axis);
        if (machine) {
            target[axis] = block.words.of(letter) - in.state_.work_offsets.rotary()[axis];
            continue;
        }
        const bool incremental = in.state_.incremental ? (block.absolute & bit) == 0 : (block.incremental & bit) != 0;
        if (incremental && std::isnan(target[axis])) {
            in.fail(
                fmt::format("an increment of {}: its angle is not known after a tool axis given as a vector", letter),
                block.words.column[static_cast<std::size_t>(letter - 'A')]);
        }
        const double from = target[axis];
        target[axis] = (incremental ? from : 0.0) + block.words.of(letter);
        // After a tool axis given as a vector the turn is unknown.
        if (!incremental && (in.state_.modulo >> axis & 1) != 0 && !std::isnan(from))
            target[axis] += whole_turns(block, bit, target[axis], from);
    }
    return target;
}

bool ends_by_angle(const ModalState& state, const Block& block) {
    if (block.find("ANG") == nullptr || (state.motion != MotionMode::rapid && state.motion != MotionMode::feed))
        return false;
    return block.words.given("XYZ"[(state.plane_axis + 1) % 3]) != block.words.given("XYZ"[(state.plane_axis + 2) % 3]);
}

}  // namespace clsurf
