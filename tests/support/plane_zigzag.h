#pragma once
// A zigzag over a plane, in which speeds and heights can be planted.

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "planted_log.h"

namespace clsurf::test {

inline constexpr double usual_step_over = 0.3;  // [mm] between passes of plane_zigzag …
inline constexpr double pass_length = 24.0;     // [mm] … and their length

/// A zigzag of 24 passes over a plane. `speed`: [mm/s] on a pass at x, at the arc length s [mm] of the pass. `apart` [mm].
template <typename Speed>
planted::PlantedLog plane_zigzag(Speed&& speed, double apart = usual_step_over) {
    constexpr int passes = 24;
    planted::PlantedLog log;
    const double period = log.recipe.period = 0.001;
    log.program = "G1 F3000 X0 Y0 Z0\n";
    const auto put = [&](double x, double y, std::uint32_t line, int pass) {
        const double p[3] = {x, y, 0};
        for (int axis = 0; axis < 3; ++axis) {
            log.commanded[axis].push_back(p[axis]);
            log.measured[axis].push_back(p[axis]);
        }
        log.line.push_back(line);
        log.pass.push_back(pass);
    };
    std::uint32_t line = 1;
    for (int k = 0; k < passes; ++k) {
        const bool back = k % 2 == 1;
        const double y = k * apart;
        log.program += fmt::format("X{} Y{}\n", back ? 0.0 : pass_length, y);
        ++line;
        for (double s = 0; s < pass_length;) {
            const double x = back ? pass_length - s : s;
            put(x, y, line, k);
            s += period * speed(k, x, s);
        }
        if (k + 1 == passes) break;
        log.program += fmt::format("Y{}\n", y + apart);
        ++line;
        for (double s = 0; s < apart; s += 0.01) put(back ? 0.0 : pass_length, y + s, line, -1);
    }
    return log;
}

/// Lifts the measured positions of some passes by `height` [mm] from x = `from` to `to`, with edges of 0.5 mm.
template <typename Taken>
void lift(planted::PlantedLog& log, double height, double from, double to, Taken&& taken) {
    for (std::size_t i = 0; i < log.pass.size(); ++i) {
        if (log.pass[i] < 0 || !taken(log.pass[i])) continue;
        const double x = log.commanded[0][i];
        const double inside = std::clamp(2 * std::min(x - from, to - x), 0.0, 1.0);
        log.measured[2][i] += height * inside;
    }
}

}  // namespace clsurf::test
