#include "cli/programs/simulation_text.h"

#include <array>

#include <fmt/format.h>

#include "core/units.h"

namespace clsurf::cli {

std::string summary_text(const SimulationSummary& s) {
    std::string text = fmt::format("{} points, {:.3f} s\n", s.points, s.duration);
    text += fmt::format("{:<24} {:.0f} mm/min\n", "greatest path speed", s.max_speed * seconds_per_minute);
    const auto row = [&](const char* name, const Vec3& v, const char* unit) {
        text += fmt::format("{:<24} x {:.0f}, y {:.0f}, z {:.0f} {}\n", name, v.x(), v.y(), v.z(), unit);
    };
    row("greatest acceleration", s.max_acceleration, "mm/s²");
    row("greatest jerk", s.max_jerk, "mm/s³");
    text += fmt::format("{:<24} {:.4f} mm\n", "off the path", s.path_deviation);
    for (std::size_t i = 0; i < s.limited_by.size(); ++i) {
        if (s.limited_by[i] == 0) continue;
        text += fmt::format("{:<24} {:5.1f} % of the points\n", name_of(static_cast<LimitingFactor>(i)),
                            100.0 * static_cast<double>(s.limited_by[i]) / static_cast<double>(s.points));
    }
    return text;
}

std::string rotary_text(const FiveAxisSummary& s, const Kinematics& k) {
    std::string text;
    const auto row = [&](const char* name, const std::array<double, 2>& v, double factor, const char* unit) {
        text += fmt::format("{:<24} {} {:.0f}, {} {:.0f} {}\n", name, k.tilt.letter, v[0] * factor, k.rotation.letter,
                            v[1] * factor, unit);
    };
    row("greatest axis speed", s.max_speed, deg_per_rad * seconds_per_minute, "deg/min");
    row("greatest acceleration", s.max_acceleration, deg_per_rad, "deg/s²");
    row("greatest jerk", s.max_jerk, deg_per_rad, "deg/s³");
    return text +
           fmt::format("{:<24} {:.4f} deg off the great circles\n", "tool axis", s.orientation_error * deg_per_rad);
}

}  // namespace clsurf::cli
