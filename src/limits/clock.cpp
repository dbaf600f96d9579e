#include "limits/clock.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

#include "core/geometry.h"
#include "log/jump_rule.h"

namespace clsurf {
namespace {

// A lost record makes a difference of a whole period.
constexpr double lost_share = 0.5;  ///< share of a period: a clock step that differs by more is broken
// beyond_limit, certain_jerk, long_step, short_step: docs/limits.md#how-certain, lost and repeated records.
constexpr double beyond_limit = 20;  ///< times the limit of acceleration
constexpr double slack = 0.02;       ///< share of a limit by which a motion at the limit may exceed it
constexpr double certain_jerk = 3;   ///< multiple of the limit: if steps are even otherwise, more means lost records
constexpr double long_step = 1.6;    ///< factor of the adjacent steps
constexpr double short_step = 0.45;  ///< factor of the adjacent steps

void read_clock(const Log& log, const ClockRules& rules, PointIndex begin, StepClock& steps) {
    const Channel* time = log.find("time");
    if (time == nullptr) return;
    const std::size_t n = steps.broken.size();
    std::vector<double> times(n);
    copy_block(time->values, begin, times);
    std::vector<double> late(n, 0.0);
    bool steady = true;
    for (std::size_t i = 1; i < n; ++i) {
        const double off = times[i] - times[i - 1] - log.period;
        const bool broken = !(std::abs(off) <= lost_share * log.period);
        if (broken) steps.broken[i] = 1;
        late[i] = late[i - 1] + (broken ? 0 : off);
        // Rounding of the clock is not caused by the machine.
        steady = steady && (broken || std::abs(off) <= 2 * rules.time_resolution + 1e-6 * log.period);
    }
    if (!steady) steps.late = std::move(late);
}

/// Detects lost and repeated records: one step is too long or too short, and the next one is not.
bool looks_lost(const Vec3& before, const Vec3& step, const Vec3& after, double allowed) {
    const Vec3 in = step - before, out = after - step;
    if (!(in.squaredNorm() > allowed * allowed) || !(out.squaredNorm() > allowed * allowed)) return false;
    if (in.dot(out) >= 0) return false;
    const double length = step.norm();
    const double shorter = std::min(before.norm(), after.norm()), longer = std::max(before.norm(), after.norm());
    return length > long_step * longer || length < short_step * shorter;
}

/// Detects a step that is a whole multiple of the previous one: several records are lost in succession.
bool is_multiple(const Vec3& before, const Vec3& step, double allowed) {
    const double shorter = std::min(before.norm(), step.norm()), longer = std::max(before.norm(), step.norm());
    if (!(shorter > 2 * allowed)) return false;
    const double times = std::round(longer / shorter);
    if (times < 2) return false;
    const Vec3 off = before.norm() < step.norm() ? Vec3(step - times * before) : Vec3(before - times * step);
    return off.norm() < 0.5 * times * allowed;
}

/// Whether the middle one of five steps equals two or three steps that the limit allows, between steps that keep it. Near
/// standstill, only this distinguishes a lost record from a short violation.
bool fits_more_periods(const std::array<Vec3, 5>& steps, double allowed) {
    // Each axis has its own limit.
    const auto greatest = [](const Vec3& of_axes) { return of_axes.cwiseAbs().maxCoeff(); };
    const auto change = [&](std::size_t i) { return greatest(steps[i] - steps[i - 1]); };
    if (change(1) > allowed || change(4) > allowed) return false;
    for (const double periods : {2.0, 3.0}) {
        const Vec3 sum = 0.5 * periods * (steps[1] + steps[3]);  // if the step changes at a constant rate
        const double bulge = periods == 2 ? 1.5 : 3.0;
        if (greatest(steps[2] - sum) <= bulge * allowed && greatest(steps[3] - steps[1]) <= (periods + 1) * allowed)
            return true;
    }
    return false;
}

/// Divides the middle step into parts so that the second differences of all steps are least. Returns their root mean
/// square, of the axis with the greatest one. 0 parts: the middle step is left out.
double unevenness(const std::array<Vec3, 5>& steps, int parts) {
    // Unknowns: the differences of the parts from equal shares. They add up to 0, so the last one follows from the others.
    const int free = std::max(0, parts - 1), rows = parts + 2;
    Eigen::MatrixXd known(parts + 4, 3), by_free = Eigen::MatrixXd::Zero(parts + 4, free);
    known.row(0) = steps[0], known.row(1) = steps[1];
    for (int k = 0; k < parts; ++k) known.row(2 + k) = steps[2] / parts;
    known.row(parts + 2) = steps[3], known.row(parts + 3) = steps[4];
    for (int k = 0; k < free; ++k) by_free(2 + k, k) = 1, by_free(1 + parts, k) = -1;
    const auto second_differences = [&](const Eigen::MatrixXd& of) {
        return Eigen::MatrixXd(of.topRows(rows) - 2 * of.middleRows(1, rows) + of.bottomRows(rows));
    };
    Eigen::MatrixXd left = second_differences(known);
    if (free > 0) {
        const Eigen::MatrixXd a = second_differences(by_free);
        left -= a * (a.transpose() * a).ldlt().solve(a.transpose() * left);
    }
    return std::sqrt(left.colwise().squaredNorm().maxCoeff() / rows);
}

/// Whether one to three lost records, or a repeated one, explain the middle one of five steps of a motion that keeps its
/// jerk limit.
bool hides_records(const std::array<Vec3, 5>& steps, double allowed, double resolution) {
    if (steps[2].cwiseAbs().maxCoeff() <= resolution) return unevenness(steps, 0) <= allowed;
    for (const int parts : {2, 3, 4}) {
        if (unevenness(steps, parts) <= allowed) return true;
    }
    return false;
}

}  // namespace

StepClock judge_steps(const Log& log, const ClockRules& rules, PointIndex begin, std::span<const double> x,
                      std::span<const double> y, std::span<const double> z) {
    const std::size_t n = x.size();
    StepClock steps{std::vector<char>(n, 0), {}};
    read_clock(log, rules, begin, steps);
    const double square_of_period = log.period * log.period;
    const double kept = (1 + slack) * rules.acceleration * square_of_period + 4 * rules.resolution;
    const double allowed = 2 * rules.acceleration * square_of_period + 4 * rules.resolution;
    const double jump = std::max(impossible_acceleration, beyond_limit * rules.acceleration) * square_of_period;
    const auto step = [&](std::size_t i) { return Vec3(x[i] - x[i - 1], y[i] - y[i - 1], z[i] - z[i - 1]); };
    const double kept_jerk = (1 + slack) * rules.jerk * square_of_period * log.period;
    const double even = kept_jerk + 4 * rules.resolution, certain = certain_jerk * kept_jerk + 4 * rules.resolution;
    for (std::size_t i = 3; rules.jerk > 0 && i + 2 < n; ++i) {
        const auto third = [&](std::span<const double> p) {
            return std::abs(p[i + 1] - 3 * p[i] + 3 * p[i - 1] - p[i - 2]);
        };
        if (std::max({third(x), third(y), third(z)}) <= certain) continue;
        if (hides_records({step(i - 2), step(i - 1), step(i), step(i + 1), step(i + 2)}, even, rules.resolution))
            steps.broken[i] = 1;
    }
    for (std::size_t i = 2; i < n; ++i) {
        // Most records are clean; this is the least expensive check.
        const double second_x = x[i] - 2 * x[i - 1] + x[i - 2], second_y = y[i] - 2 * y[i - 1] + y[i - 2],
                     second_z = z[i] - 2 * z[i - 1] + z[i - 2];
        const double squared_difference = second_x * second_x + second_y * second_y + second_z * second_z;
        if (!(std::max({std::abs(second_x), std::abs(second_y), std::abs(second_z)}) > kept)) continue;
        if (i >= 3 && i + 2 < n &&
            fits_more_periods({step(i - 2), step(i - 1), step(i), step(i + 1), step(i + 2)}, kept))
            steps.broken[i] = 1;
        if (i >= 4 && i + 1 < n &&
            fits_more_periods({step(i - 3), step(i - 2), step(i - 1), step(i), step(i + 1)}, kept))
            steps.broken[i - 1] = 1;
        if (!(squared_difference > allowed * allowed)) continue;
        const Vec3 before = step(i - 1), here = step(i);
        if (squared_difference > jump * jump || is_multiple(before, here, allowed))
            steps.broken[i - 1] = steps.broken[i] = 1;
        if (i + 1 < n && looks_lost(before, here, step(i + 1), allowed)) steps.broken[i] = 1;
    }
    return steps;
}

}  // namespace clsurf
