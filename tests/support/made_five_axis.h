#pragma once
// A five-axis log made by interpolating a program at constant speed: with tool centre point
// control tip and angles, otherwise the axes themselves.

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/units.h"
#include "log/log.h"
#include "machine/kinematics.h"
#include "program/interpreter.h"
#include "program/tool_centre_point.h"
#include "toolpath/toolpath.h"

namespace clsurf::test {

inline Program parse_text(const std::string& text, const char* dialect = "fanuc") {
    auto kept = std::make_shared<std::string>(text);
    InterpreterOptions options;
    options.dialect = find_dialect(dialect);
    return parse_program(SourceText("made.nc", *kept, kept), options);
}

/// A trunnion whose axes do not intersect, with a workpiece off its centre.
inline Kinematics trunnion() {
    Kinematics k;
    k.type = KinematicsType::table_table;
    k.tilt_point = {1.5, -0.7, 60};
    k.centre_from_tilt = {-1.5, 0.8, -35};
    k.rotation_centre = {0, 0.1, 25};
    return k;
}

struct MadeLog {
    std::vector<double> axes[5];  ///< x, y, z [mm], a, c [deg], commanded
    std::vector<double> feedback[5];
    std::vector<double> line;
    double tilt_sign = 1;  ///< sign of the control's angles
    Log log;

    void add(const Vec3& linear, const RotaryAngles& angles, double at_line) {
        for (int k = 0; k < 3; ++k) axes[k].push_back(linear[k]);
        axes[3].push_back(tilt_sign * angles.tilt * deg_per_rad);
        axes[4].push_back(angles.rotation * deg_per_rad);
        line.push_back(at_line);
    }
    void finish(double period) {
        log.name = "made";
        log.period = period;
        log.records = static_cast<PointIndex>(line.size());
        const auto view = [&](const std::vector<double>& v) {
            return ChannelView{
                reinterpret_cast<const std::byte*>(v.data()), 8, log.records, ScalarType::f64, false, 1, 0};
        };
        for (int k = 0; k < 5; ++k) {
            log.channels.push_back({std::string("cmd.") + "xyzac"[k], k < 3 ? "mm" : "deg", view(axes[k])});
            if (!feedback[0].empty())
                log.channels.push_back({std::string("fb.") + "xyzac"[k], k < 3 ? "mm" : "deg", view(feedback[k])});
        }
    }
};

/// Interpolates with steps of `step` mm of the programmed arc length, or of half a degree if only angles turn.
/// `zero`: machine position of the program's zero [mm]. After tool centre point control is turned off, an axis stays
/// where it is until a word moves it.
inline MadeLog run(const Program& program, const Kinematics& kinematics, const Vec3& zero, double step) {
    MadeLog made;
    ToolCentrePoint control(program);
    const Toolpath path(program.motions, Vec3::Zero());
    made.tilt_sign = kinematics.tilt.sign;
    RotaryAngles before;
    Vec3 at = zero + kinematics.zero_position();  // position of the axes
    Vec3 word = Vec3::Zero();
    for (std::int64_t m = 0; m < path.size(); ++m) {
        const RotaryAngles after = kinematics.angles_of(
            program.motions.rotary.empty() ? Vec3(0, 0, 0) : program.motions.rotary[static_cast<std::size_t>(m)].vec());
        const double turn = std::max(std::abs(after.tilt - before.tilt), std::abs(after.rotation - before.rotation));
        const int steps =
            std::max({1, static_cast<int>(path.length(m) / step), static_cast<int>(turn * deg_per_rad / 0.5)});
        const bool tips = control.on(m);
        const Vec3 to =
            (path.end(m).array() == word.array()).select(at, path.end(m) + zero + kinematics.zero_position());
        for (int i = 1; i <= steps; ++i) {
            const double part = static_cast<double>(i) / steps;
            const RotaryAngles angles{before.tilt + part * (after.tilt - before.tilt),
                                      before.rotation + part * (after.rotation - before.rotation)};
            Vec3 linear = tips ? kinematics.to_axes(path.at(m, part) + zero, angles) : at + part * (to - at);
            if (!tips && is_arc(program.motions.kind[static_cast<std::size_t>(m)]))
                linear = path.at(m, part) + zero + kinematics.zero_position();
            made.add(linear, angles, program.motions.line[static_cast<std::size_t>(m)]);
        }
        before = after;
        word = path.end(m);
        at = Vec3(made.axes[0].back(), made.axes[1].back(), made.axes[2].back());
    }
    return made;
}

/// A zigzag over a dome of radius 80, the tool normal to it, under G43.4.
inline std::string dome_program() {
    std::string text = "G21 G90 G54\nG0 X-20 Y-10 Z40 A0 C0\nG43.4 H1\nF3000\n";
    double c = 0;
    for (int pass = 0; pass < 8; ++pass) {
        for (int i = 0; i <= 40; ++i) {
            const double x = (pass % 2 == 0 ? -20.0 + i : 20.0 - i);
            const double y = -10 + 1.5 * pass;
            const double z = std::sqrt(80 * 80 - x * x - y * y) - 80;
            const Vec3 n = Vec3(x, y, z + 80) / 80;
            const double a = std::atan2(std::hypot(n.x(), n.y()), n.z()) * deg_per_rad;
            double turn = std::atan2(n.x(), -n.y()) * deg_per_rad;
            turn += 360 * std::round((c - turn) / 360);
            c = turn;
            if (pass == 0 && i == 0)
                text += fmt::format("G0 X{:.4f} Y{:.4f} Z{:.4f} A{:.4f} C{:.4f}\n", x, y, z + 10, a, c);
            text += fmt::format("G1 X{:.4f} Y{:.4f} Z{:.4f} A{:.4f} C{:.4f}\n", x, y, z, a, c);
        }
    }
    return text + "G49\nG0 Z60\nM30\n";
}

}  // namespace clsurf::test
