#include "identify/servo_start.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Dense>

namespace clsurf {
namespace {

constexpr std::size_t width = 8;  ///< number of averaged records
constexpr int unknowns = 5;
using Normal = Eigen::Matrix<double, unknowns, unknowns>;
using Right = Eigen::Matrix<double, unknowns, 1>;

struct Regression {
    Normal normal = Normal::Zero();
    Right right = Right::Zero();
    double squares = 0;
    PointIndex count = 0;
};

/// v = (1 − s) v₋ + s Kv (cmd − x)₋ + s c_ff cmd′ − s f sign(v₋) + constant, all averaged, `dead` periods late.
void add_piece(std::span<const double> commanded, std::span<const double> feedback, double period, std::size_t dead,
               Regression& sums) {
    const double per_time = 1 / (static_cast<double>(width) * period);
    double error = 0;  // Σ of cmd − x over the `width` records before i
    const std::size_t begin = width + 1 + dead;
    for (std::size_t i = begin; i < commanded.size(); ++i) {
        const auto difference = [&](std::size_t k) { return commanded[k - dead] - feedback[k]; };
        if (i == begin) {
            for (std::size_t k = i - width; k < i; ++k) error += difference(k);
        } else {
            error += difference(i - 1) - difference(i - 1 - width);
        }
        const double before = (feedback[i - 1] - feedback[i - 1 - width]) * per_time;
        const double target = (feedback[i] - feedback[i - width]) * per_time;
        const double asked = (commanded[i - dead] - commanded[i - dead - width]) * per_time;
        if (asked == 0 && before == 0) continue;  // at rest nothing can be observed
        Right row;
        row << before, error / static_cast<double>(width), asked, before > 0 ? 1.0 : (before < 0 ? -1.0 : 0.0), 1.0;
        sums.normal += row * row.transpose();
        sums.right += row * target;
        sums.squares += target * target;
        ++sums.count;
    }
}

std::optional<ServoStart> solve(const Regression& sums, double period, std::size_t dead) {
    if (sums.count < 50) return std::nullopt;
    const Right scale = sums.normal.diagonal().cwiseMax(1e-30).cwiseSqrt().cwiseInverse();
    Normal scaled = scale.asDiagonal() * sums.normal * scale.asDiagonal();
    scaled.diagonal().array() += 1e-12;
    const Right solution = scale.asDiagonal() * Right(scaled.ldlt().solve(scale.asDiagonal() * sums.right));
    if (!solution.allFinite()) return std::nullopt;
    ServoStart start;
    start.mean_square = std::max(0.0, sums.squares - solution.dot(sums.right)) / static_cast<double>(sums.count);
    const double step = std::clamp(1 - solution[0], 0.02, 1.0);
    ServoParameters& p = start.parameters;
    p[ServoTerm::velocity_step] = step;
    p[ServoTerm::log_gain] = std::log(std::clamp(solution[1] / step, std::min(1.0, 0.5 / period), 0.5 / period));
    p[ServoTerm::feedforward] = std::clamp(solution[2] / step, 0.0, 1.5);
    start.friction = std::max(-solution[3] / step, 0.0);
    p[ServoTerm::dead_time] = static_cast<double>(dead);
    return start;
}

}  // namespace

ServoParameters lags_of(const ServoProblem& problem) {
    using Lags = Eigen::Vector4d;
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Lags right = Lags::Zero();
    const double time = static_cast<double>(width) * problem.period();
    problem.for_each_piece([&](std::span<const double> commanded, std::span<const double> feedback) {
        for (std::size_t i = static_cast<std::size_t>(problem.settling()) + width; i + width < commanded.size(); ++i) {
            const double before = (commanded[i] - commanded[i - width]) / time;
            const double after = (commanded[i + width] - commanded[i]) / time;
            const double speed = (before + after) / 2;
            if (speed == 0) continue;
            const Lags row(speed, (after - before) / time, std::copysign(1.0, speed), 1);
            normal += row * row.transpose();
            right += row * (commanded[i] - feedback[i]);
        }
    });
    const Lags scale = normal.diagonal().cwiseMax(1e-30).cwiseSqrt().cwiseInverse();
    Eigen::Matrix4d scaled = scale.asDiagonal() * normal * scale.asDiagonal();
    scaled.diagonal().array() += 1e-9;
    const Lags lags = scale.asDiagonal() * Lags(scaled.ldlt().solve(scale.asDiagonal() * right));
    ServoParameters p;
    p[ServoTerm::feedforward] = lags[0];
    p[ServoTerm::velocity_step] = lags[1];
    p[ServoTerm::friction] = std::max(lags[2], 0.0);
    return p;
}

std::vector<ServoStart> servo_starts(const ServoProblem& problem, int most_dead_periods) {
    std::vector<Regression> sums(static_cast<std::size_t>(most_dead_periods) + 1);
    problem.for_each_piece([&](std::span<const double> commanded, std::span<const double> feedback) {
        for (std::size_t dead = 0; dead < sums.size(); ++dead)
            add_piece(commanded, feedback, problem.period(), dead, sums[dead]);
    });
    std::vector<ServoStart> starts;
    for (std::size_t dead = 0; dead < sums.size(); ++dead) {
        if (const std::optional<ServoStart> start = solve(sums[dead], problem.period(), dead)) starts.push_back(*start);
    }
    std::stable_sort(starts.begin(), starts.end(),
                     [](const ServoStart& a, const ServoStart& b) { return a.mean_square < b.mean_square; });
    return starts;
}

}  // namespace clsurf
