#pragma once
// Runs made for tests: a tool follows a path of known arc length at a known speed, optionally with pauses and
// measured positions. The arc length of every point is stored, so that an alignment can
// be compared with the truth.

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <vector>

#include "compare/run_difference.h"
#include "log/log.h"
#include "toolpath/trajectory.h"

namespace clsurf::test {

/// A position as a function of arc length [mm].
using PathOfArcLength = std::function<Vec3(double)>;

struct RunRecipe {
    PathOfArcLength path;
    double begin = 0, end = 100;                                        ///< [mm] of arc length
    double period = 0.001;                                              ///< [s]
    std::function<double(double)> speed = [](double) { return 30.0; };  ///< [mm/s] by arc length
    std::vector<std::pair<double, double>> pauses;  ///< pauses at an arc length [mm], for a time [s]
    std::function<Vec3(double)> off = [](double) -> Vec3 {
        return Vec3::Zero();
    };  ///< measured minus commanded, by arc length
    std::function<Vec3(double)> shift = [](double) -> Vec3 {
        return Vec3::Zero();
    };                 ///< displacement of all positions, by arc length
    double phase = 0;  ///< share of a period after which sampling begins
};

struct MadeRun {
    Log log;
    std::vector<double> arc_length;  ///< arc length of every point
    std::shared_ptr<std::vector<double>> columns = std::make_shared<std::vector<double>>();

    [[nodiscard]] ComparedRun run() const {
        ComparedRun run;
        run.log = &log;
        run.path = reconstruct(log, Role::commanded, Vec3::Zero());
        run.commanded = run.path;
        run.measured = reconstruct(log, Role::feedback, Vec3::Zero());
        run.truest = run.measured;
        return run;
    }
    /// The arc length at a path location.
    [[nodiscard]] double arc_length_at(const PathLocation& at) const {
        const auto i = static_cast<std::size_t>(at.point);
        return at.fraction == 0 ? arc_length[i] : arc_length[i] + at.fraction * (arc_length[i + 1] - arc_length[i]);
    }
};

inline MadeRun make_run(const RunRecipe& recipe) {
    MadeRun made;
    std::vector<Vec3> commanded;
    std::vector<Vec3> measured;
    const auto put = [&](double s) {
        made.arc_length.push_back(s);
        commanded.push_back(recipe.path(s) + recipe.shift(s));
        measured.push_back(commanded.back() + recipe.off(s));
    };
    auto pause = recipe.pauses.begin();
    for (double s = recipe.begin + recipe.phase * recipe.period * recipe.speed(recipe.begin); s <= recipe.end;) {
        put(s);
        if (pause != recipe.pauses.end() && s >= pause->first) {
            for (double t = 0; t < pause->second; t += recipe.period) put(s);
            ++pause;
        }
        s += recipe.period * recipe.speed(s);
    }
    const std::size_t n = commanded.size();
    made.columns->resize(6 * n);
    made.log.name = "made";
    made.log.format = "made";
    made.log.records = static_cast<PointIndex>(n);
    made.log.period = recipe.period;
    made.log.keep_alive = made.columns;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < n; ++i) {
            (*made.columns)[axis * n + i] = commanded[i][static_cast<Eigen::Index>(axis)];
            (*made.columns)[(3 + axis) * n + i] = measured[i][static_cast<Eigen::Index>(axis)];
        }
        for (const std::size_t role : {0, 3}) {
            const double* first = made.columns->data() + (role + axis) * n;
            made.log.channels.push_back({std::string(role == 0 ? "cmd." : "fb.") + "xyz"[axis],
                                         "mm",
                                         {reinterpret_cast<const std::byte*>(first), sizeof(double), made.log.records,
                                          ScalarType::f64, false, 1.0, 0.0}});
        }
    }
    return made;
}

/// Passes along X of `length` mm, 2 mm apart, joined by half circles, on a plane that rises along Y.
inline PathOfArcLength rounded_zigzag(double length) {
    return [length](double s) {
        constexpr double radius = 1.0;
        const double piece = length + std::numbers::pi * radius;
        const double k = std::floor(s / piece);
        const double along = s - k * piece;
        const bool forth = std::fmod(k, 2.0) == 0;
        const double turned = along > length ? (along - length) / radius : 0;
        const double u = along <= length ? along : length + radius * std::sin(turned);
        const double y = 2 * radius * k + radius * (1 - std::cos(turned));
        return Vec3(forth ? u : length - u, 0.8 * y, 0.6 * y);
    };
}

/// The same circle repeatedly, then away from it.
inline PathOfArcLength circles(double radius, int turns) {
    return [radius, turns](double s) {
        const double whole = 2 * std::numbers::pi * radius * turns;
        if (s > whole) return Vec3(radius, s - whole, 0);
        return Vec3(radius * std::cos(s / radius), radius * std::sin(s / radius), 0);
    };
}

/// A curve that crosses itself many times. The parameter is only roughly its arc length.
inline PathOfArcLength crossing_curve() {
    return [](double s) { return Vec3(20 * std::sin(3 * s / 50), 20 * std::sin(2 * s / 50 + 0.4), std::sin(s / 17)); };
}

}  // namespace clsurf::test
