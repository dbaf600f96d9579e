// Parameters that the controller keeps: positions, offsets, modes, by number and by name.

#include <cmath>

#include "core/not_finite.h"
#include "program/interpret/interpreter_state.h"

namespace clsurf {
namespace {

/// #<_motion_mode>: the code in tenths.
int code_of(MotionMode mode, int cycle) {
    switch (mode) {
        case MotionMode::rapid: return 0;
        case MotionMode::feed: return 10;
        case MotionMode::cw: return 20;
        case MotionMode::ccw: return 30;
        case MotionMode::thread: return 330;
        case MotionMode::tap: return 331;
        case MotionMode::cubic_spline: return 50;
        case MotionMode::quadratic_spline: return 51;
        case MotionMode::nurbs: return 52;
        case MotionMode::probe: return 382;
        case MotionMode::cycle: return cycle;
        case MotionMode::none: return 800;
    }
    return 800;
}

}  // namespace

double Interpreter::parameter(int number) const {
    const double unit = state_.unit_mm;
    const double machine_unit = tools_.unit_mm;
    const Vec3 at = tool_position();
    const Vec3 known = at.array().isNaN().select(0.0, at);
    const auto axis_of = [&](int first, const Vec3& lengths, const Vec3& angles, double per) {
        const int k = number - first;
        return k < 3 ? lengths[k] / per : k < 6 ? angles[k - 3] : 0.0;
    };
    const Vec3 none_turned = Vec3::Zero();
    if (dialect_ == DialectId::linuxcnc) {
        if (number >= 5420 && number <= 5428) return axis_of(5420, known, state_.rotary, unit);
        if (number >= 5161 && number <= 5169) return axis_of(5161, state_.home, state_.home_rotary, machine_unit);
        if (number >= 5181 && number <= 5189)
            return axis_of(5181, state_.second_home, state_.second_home_rotary, machine_unit);
        if (number >= 5211 && number <= 5219) return axis_of(5211, state_.shift, state_.rotary_shift, machine_unit);
        if (number == 5220) return state_.work_system;
        if (number >= 5221 && number < 5221 + 9 * 20) {
            const int system = (number - 5221) / 20 + 1;
            const int axis = (number - 5221) % 20;
            const auto found = state_.work_offsets.find(system);
            const WorkOffset offset = found == state_.work_offsets.end() ? WorkOffset{} : found->second;
            if (axis == 9) return offset.rotation;
            if (axis >= 3 && axis < 6) return offset.rotary[axis - 3];
            return axis < 3 ? offset.shift[axis] / machine_unit : 0.0;
        }
        switch (number) {
            case 5400: return tool_.number;
            case 5410: return tool_.diameter / machine_unit;
            case 5411: return tool_.front_angle;
            case 5412: return tool_.back_angle;
            case 5413: return tool_.orientation;
            default: break;
        }
        if (number >= 5401 && number <= 5409) return axis_of(5401, tool_.offset, none_turned, machine_unit);
        return missing<double>;
    }
    if (dialect_ == DialectId::fanuc) return fanuc_parameter(number, known);
    return missing<double>;
}

/// Names of LinuxCNC, "Predefined Named Parameters"; those of what a program cannot know are missing.
double Interpreter::named_parameter(const std::string& name) const {
    if (dialect_ == DialectId::siemens && name.starts_with('$')) {
        unknown_name_ = name;
        return 0;
    }
    if (dialect_ != DialectId::linuxcnc || name.size() < 2) return missing<double>;
    const double unit = state_.unit_mm;
    const Vec3 at = tool_position();
    const Vec3 machine = state_.to_machine(at);
    for (int k = 0; k < 3; ++k) {
        const std::string linear(1, "xyz"[k]);
        const std::string turning(1, "abc"[k]);
        if (name == "_" + linear) return at[k] / unit;
        if (name == "_abs_" + linear) return machine[k] / unit;
        if (name == "_" + turning) return state_.rotary[k];
        if (name == "_abs_" + turning) return state_.rotary[k] + state_.rotary_offset()[k];
        if (name == "_" + std::string(1, "uvw"[k])) return 0;  // axes that are not carried on
    }
    const int system = state_.work_system;
    constexpr int numbered_systems = 6;
    const std::pair<const char*, double> modes[] = {
        {"_metric", unit == 1},
        {"_imperial", unit != 1},
        {"_absolute", !state_.incremental},
        {"_incremental", state_.incremental},
        {"_inverse_time", state_.feed_mode == FeedMode::inverse_time},
        {"_units_per_minute", state_.feed_mode == FeedMode::per_minute},
        {"_units_per_rev", state_.feed_mode == FeedMode::per_revolution},
        {"_ijk_absolute_mode", state_.centre_absolute},
        {"_ijk_incremental_mode", !state_.centre_absolute},
        {"_lathe_diameter_mode", state_.diameter},
        {"_lathe_radius_mode", !state_.diameter},
        {"_retract_r_plane", state_.retract_to_r},
        {"_retract_old_z", !state_.retract_to_r},
        {"_motion_mode", code_of(state_.motion, state_.cycle)},
        {"_plane", state_.plane_axis == 2   ? 170
                   : state_.plane_axis == 1 ? 180
                                            : 190},
        {"_coord_system", system <= numbered_systems ? 530 + 10 * system : 590 + system - numbered_systems},
        {"_tool_offset", !state_.tool_offset.isZero()},
        {"_ccomp", !compensation_.on()    ? 400
                   : compensation_.left() ? 410
                                          : 420},
        {"_feed", state_.feed},
        {"_rpm", state_.spindle},
        {"_current_tool", tool_.number},
        {"_current_pocket", tool_.number},
        {"_selected_tool", next_tool_},
        {"_selected_pocket", next_tool_},
        {"_call_level", static_cast<double>(frames_.size())},
        {"_line", static_cast<double>(line_)},
        {"_value", 0},
        {"_value_returned", 0},
        {"_feed_override", 1},
        {"_speed_override", 1},
        {"_feed_hold", 1},
        {"_adaptive_feed", 0},
        {"_remap_level", 0},
        {"_task", 0},
        {"_vmajor", 2.9},
        {"_vminor", 0},
    };
    for (const auto& [known, value] : modes) {
        if (name == known) return value;
    }
    return missing<double>;
}

}  // namespace clsurf
