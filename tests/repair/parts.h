#pragma once
// Programs of small parts, and a machine on which their faults show.

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/diagnostic.h"
#include "core/units.h"
#include "machine/machine.h"
#include "program/interpreter.h"

namespace clsurf {

inline Program read_text(const std::string& text) {
    auto bytes = std::make_shared<std::string>(text);
    return parse_program(SourceText("part.nc", *bytes, bytes), {});
}

/// Blocks of 0.02 mm take 2 ms: they are run at 10 mm/s instead of 50.
inline Machine slow_at_short_blocks() {
    Machine machine;
    machine.path.max_jerk = 1e6;
    for (MachineAxis& axis : machine.axes) axis.max_jerk = 2e6;
    machine.controller.block_time = 0.002;
    return machine;
}

/// A zigzag over sine-shaped waves in z with a height [mm]: passes along x, 0.4 mm apart. `spacing(pass, x)` is the distance
/// in x to the next point.
template <typename Spacing>
std::string wavy_zigzag(int passes, double length, const Spacing& spacing, double height = 0.8) {
    const auto z = [=](double x, double y) { return height * std::sin(0.9 * x + 0.1 * y); };
    std::string text =
        "%\n(WAVES)\nG21 G90 G17 G40 G49 G80\nG64 P0.005\nS12000 M3\nG0 X0 Y0 Z10\nG1 Z0 F1000\nG1 F3000\n";
    for (int pass = 0; pass < passes; ++pass) {
        const double y = 0.4 * pass;
        const bool back = pass % 2 == 1;
        if (pass > 0)
            text += fmt::format("X{:.4f} Y{:.4f} Z{:.4f}\n", back ? length : 0.0, y, z(back ? length : 0.0, y));
        for (double arc_length = spacing(pass, 0.0); arc_length < length + 1e-9;
             arc_length += spacing(pass, arc_length)) {
            const double x = back ? length - arc_length : arc_length;
            text += fmt::format("X{:.4f} Z{:.4f}\n", x, z(x, y));
        }
        const double end = back ? 0.0 : length;
        text += fmt::format("X{:.4f} Z{:.4f}\n", end, z(end, y));
    }
    return text + "G0 Z10\nM5\nM2\n%\n";
}

/// A zigzag over a ball of radius 60 mm with the tool normal to it and at least 8° from the pole, under G43.4: passes along
/// x, 0.4 mm apart. `spacing` as above; angles have `decimals`.
template <typename Spacing>
std::string tilted_zigzag(int passes, double length, const Spacing& spacing, int decimals = 4) {
    constexpr double radius = 60, from = 10;
    std::string text = "%\n(BALL)\nG21 G90 G17 G54\nG64 P0.005\nG43.4 H1\nS12000 M3\n";
    const auto at = [&](const char* code, double x, double y, double above, const char* feed) {
        const double z = std::sqrt(radius * radius - x * x - y * y) - radius;
        const double tilt = -std::asin(std::hypot(x, y) / radius) * deg_per_rad, turn = std::atan2(-x, y) * deg_per_rad;
        text += fmt::format("{}X{:.4f} Y{:.4f} Z{:.4f} A{:.{}f} C{:.{}f}{}\n", code, x, y, z + above, tilt, decimals,
                            turn, decimals, feed);
    };
    at("G0 ", from, 0, 10, "");
    at("G1 ", from, 0, 0, " F1000");
    text += "G1 F3000\n";
    for (int pass = 0; pass < passes; ++pass) {
        const double y = 0.4 * pass;
        const bool back = pass % 2 == 1;
        const auto x = [&](double arc_length) { return from + (back ? length - arc_length : arc_length); };
        if (pass > 0) at("", x(0), y, 0, "");
        for (double arc_length = spacing(pass, 0.0); arc_length < length - 1e-9;
             arc_length += spacing(pass, arc_length))
            at("", x(arc_length), y, 0, "");
        at("", x(length), y, 0, "");
    }
    return text + "G0 Z10\nG49\nM5\nM2\n%\n";
}

}  // namespace clsurf
