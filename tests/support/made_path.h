#pragma once
// Paths made for tests: positions with known passes.

#include <cmath>
#include <numbers>

#include "surface/passes.h"

namespace clsurf::test {

inline void add(Positions& p, double x, double y, double z) {
    p.x.push_back(static_cast<float>(x));
    p.y.push_back(static_cast<float>(y));
    p.z.push_back(static_cast<float>(z));
}

/// A straight line in steps of `step`, its end excluded.
inline void add_line(Positions& p, Vec3 from, Vec3 to, double step) {
    const auto n = static_cast<int>(std::ceil((to - from).norm() / step));
    for (int i = 0; i < n; ++i) {
        const Vec3 at = from + (to - from) * i / n;
        add(p, at.x(), at.y(), at.z());
    }
}

/// A zigzag of `passes` passes along X over a plane, `apart` mm apart.
inline Positions zigzag(int passes, double length, double apart, double step) {
    Positions p;
    for (int k = 0; k < passes; ++k) {
        const double y = k * apart;
        const double from = k % 2 == 0 ? 0 : length;
        add_line(p, {from, y, 0}, {length - from, y, 0}, step);
        if (k + 1 < passes) add_line(p, {length - from, y, 0}, {length - from, y + apart, 0}, step);
    }
    return p;
}

/// An Archimedean spiral from radius `outer` inwards, turns `apart` mm apart.
inline Positions spiral(double outer, int turns, double apart, double step) {
    Positions p;
    double angle = 0;
    while (angle < 2 * std::numbers::pi * turns) {
        const double radius = outer - apart * angle / (2 * std::numbers::pi);
        add(p, radius * std::cos(angle), radius * std::sin(angle), 0);
        angle += step / radius;
    }
    return p;
}

/// Circles from radius `outer` inwards, each beginning and ending on the X axis, joined by straight steps inwards.
inline Positions loops(double outer, int count, double apart, double step) {
    Positions p;
    for (int k = 0; k < count; ++k) {
        const double radius = outer - k * apart;
        const auto n = static_cast<int>(2 * std::numbers::pi * radius / step);
        for (int i = 0; i < n; ++i) {
            const double angle = 2 * std::numbers::pi * i / n;
            add(p, radius * std::cos(angle), radius * std::sin(angle), 0);
        }
        if (k + 1 < count)
            add_line(p, {radius, 0, 0}, {radius - apart, 0, 0}, step);
        else
            add(p, radius, 0, 0);
    }
    return p;
}

inline Passes one_run(const Positions& p) {
    Passes runs;
    runs.push_back({0, p.size() - 1, PassKind::cut});
    return runs;
}

}  // namespace clsurf::test
