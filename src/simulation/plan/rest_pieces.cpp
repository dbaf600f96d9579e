#include "simulation/plan/rest_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/not_finite.h"

namespace clsurf {
namespace {

constexpr double rest_part = 0.25;     ///< share of the jerk phase next to a rest that has constant jerk
constexpr double rest_jerk = 0.95;     ///< share of the jerk that the axes allow at the rest
constexpr double rest_held = 0.9;      ///< share of that jerk that is required; a shorter piece is tried for it
constexpr double settled_share = 0.7;  ///< share of the speed limit of a following bend to which the piece may lead
constexpr std::array<double, 2> settling_jerks{1, 0.5};  ///< shares of the jerk from the rest, tried in turn
constexpr std::size_t settling_samples = 12, piece_samples = 4;
constexpr double least_rest_piece = 0.01;  ///< share of the time of a piece without joints

}  // namespace

/// The places between two values of u, in any order.
std::span<const LimitPlace> RestPieces::between(double a, double b) const {
    const auto first_from = [&](double u) {
        return std::lower_bound(places_.begin(), places_.end(), u,
                                [](const LimitPlace& place, double at) { return place.u < at; });
    };
    return {first_from(std::min(a, b)), first_from(std::max(a, b))};
}

RestPiece RestPieces::at(double rest, int side, double length) const {
    const double jerk = rest_jerk * limits_->at(rest).jerk;
    RestPiece best, shortest;
    for (double share = 1; share > least_rest_piece; share *= 0.5) {
        RestPiece piece{jerk, share * rest_part * std::min(limits_->ramp(), std::cbrt(length / (2 * jerk)))};
        piece.jerk = std::min(jerk, jerk_along(rest, side, piece.length()));
        shortest = piece;
        const auto settled = [&](double opposite) { return settles(rest, side, piece, opposite); };
        if (std::none_of(settling_jerks.begin(), settling_jerks.end(), settled)) continue;
        if (piece.jerk > best.jerk) best = piece;
        if (best.jerk > rest_held * jerk) break;
    }
    return best.jerk > 0 ? best : shortest;
}

/// Whether the acceleration at the end of a piece can return to zero before a bend, at a share of the jerk.
bool RestPieces::settles(double rest, int side, const RestPiece& piece, double share) const {
    const double first = piece.jerk * piece.time, jerk = -share * piece.jerk, time = piece.time / share;
    const double from = 0.5 * first * piece.time;
    const auto distance_after = [&](double t) {
        return piece.length() + t * (from + t * (0.5 * first + t * jerk / 6));
    };
    for (std::size_t k = 1; k <= settling_samples; ++k) {
        const double t = time * static_cast<double>(k) / settling_samples;
        const double speed = from + t * (first + 0.5 * t * jerk);
        if (!limits_->hold(rest + side * distance_after(t), side, speed, first + t * jerk, jerk)) return false;
    }
    const double speed = from + 0.5 * first * time;
    return speed <= settled_share * limits_->at(rest + side * distance_after(time)).cap &&
           slows_for_bends(rest, side, distance_after(time), speed, settling_jerks.back() * piece.jerk);
}

/// Whether a motion away from a rest can brake for the bends after `from`, at a jerk and with zero acceleration at first.
bool RestPieces::slows_for_bends(double rest, int side, double from, double speed, double jerk) const {
    const double begin = rest + side * from, reach = begin + side * speed * std::sqrt(speed / jerk);
    for (const LimitPlace& place : between(begin, reach)) {
        const double slow = settled_share * place.cap;
        const double needed = slow < speed ? (speed + slow) * std::sqrt((speed - slow) / jerk) : 0;
        if (std::abs(place.u - begin) < needed) return false;
    }
    return true;
}

/// The constant jerk that all places within a length from a rest allow. Then v = j t²/2, v' = j t and 6 u = j t³, so that
/// the jerk of an axis is j (x′ + 9 u x″ + 9/2 u² x‴), and its acceleration j t (x′ + 3/2 u x″).
double RestPieces::jerk_along(double rest, int side, double length) const {
    double most = infinite;
    for (const LimitPlace& place : between(rest, rest + side * length))
        most = std::min(most, jerk_at(place.u, rest, side));
    for (std::size_t k = 1; k <= piece_samples; ++k)
        most = std::min(most, jerk_at(rest + side * length * static_cast<double>(k) / piece_samples, rest, side));
    return most;
}

double RestPieces::jerk_at(double at, double rest, int side) const {
    const double u = std::abs(at - rest), root = std::cbrt(6 * u);  // t = root / cbrt(j)
    if (!(u > 0)) return infinite;
    const ProblemLimits<5>& limits = limits_->of_axes();
    AxisSample<5> d;
    const LimitPlace place = limits_->at(at, d);
    double most = 8 * place.free_cap * place.free_cap * place.free_cap / (root * root * root * root);
    const auto hold = [&](double jerk, double jerk_limit, double acceleration, double acceleration_limit) {
        if (jerk_limit > 0) most = std::min(most, rest_jerk * jerk_limit / std::abs(jerk));
        most = std::min(most, std::pow(acceleration_limit / (root * std::abs(acceleration)), 1.5));
    };
    for (int k = 0; k < 5; ++k) {
        const double second = side * d.second[k];
        hold(d.first[k] + u * (9 * second + 4.5 * u * d.third[k]), limits.jerk[k], d.first[k] + 1.5 * u * second,
             limits.acceleration[k]);
    }
    const double pace_slope = side * d.pace.slope;
    hold(d.pace.value + u * (9 * pace_slope + 4.5 * u * d.pace.curve), limits.path_jerk,
         d.pace.value + 1.5 * u * pace_slope, limits.path_acceleration);
    return most;
}

}  // namespace clsurf
