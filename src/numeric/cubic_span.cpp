#include "numeric/cubic_span.h"

#include <cmath>

namespace clsurf {
namespace {

constexpr double arc_length_exact = 1e-12;  ///< tolerance of Newton's method, relative to the chord
constexpr int most_steps = 60;
constexpr double length_exact = 1e-10;  ///< greatest relative change of the length if the pieces are doubled
constexpr int most_pieces = 64;

}  // namespace

Vec3 CubicSpan::at(double u) const {
    return coefficients[0] + u * (coefficients[1] + u * (coefficients[2] + u * coefficients[3]));
}

Vec3 CubicSpan::derivative(double u) const {
    return coefficients[1] + u * (2 * coefficients[2] + 3 * u * coefficients[3]);
}

Vec3 CubicSpan::second_derivative(double u) const { return 2 * coefficients[2] + 6 * u * coefficients[3]; }

double CubicSpan::arc_length_to(double u) const {
    static constexpr std::array<double, 5> node{0, -0.5384693101056831, 0.5384693101056831, -0.9061798459386640,
                                                0.9061798459386640};
    static constexpr std::array<double, 5> weight{0.5688888888888889, 0.4786286704993665, 0.4786286704993665,
                                                  0.2369268850561891, 0.2369268850561891};
    const double half = 0.5 * u / pieces;
    double sum = 0;
    for (int piece = 0; piece < pieces; ++piece) {
        for (std::size_t k = 0; k < node.size(); ++k)
            sum += weight[k] * derivative(half * (1 + 2 * piece + node[k])).norm();
    }
    return half * sum;
}

void CubicSpan::choose_pieces() {
    pieces = 1;
    double before = arc_length_to(chord);
    while (pieces < most_pieces) {
        pieces *= 2;
        const double length = arc_length_to(chord);
        if (std::abs(length - before) <= length_exact * length) {
            pieces /= 2;
            return;
        }
        before = length;
    }
}

double CubicSpan::at_arc_length(double arc_length, double length) const {
    double low = 0, high = chord;
    if (arc_length <= 0) return low;
    if (arc_length >= length) return high;
    double u = chord * arc_length / length;
    for (int step = 0; step < most_steps; ++step) {
        const double over = arc_length_to(u) - arc_length;
        if (std::abs(over) <= arc_length_exact * chord) break;
        (over > 0 ? high : low) = u;
        const double speed = derivative(u).norm();
        const double next = speed > 0 ? u - over / speed : high;
        u = next > low && next < high ? next : 0.5 * (low + high);
    }
    return u;
}

CubicSpan hermite(const Vec3& begin, const Vec3& end, const Vec3& derivative_at_begin, const Vec3& derivative_at_end,
                  double chord) {
    const Vec3 slope = (end - begin) / chord;
    return {{begin, derivative_at_begin, (3 * slope - 2 * derivative_at_begin - derivative_at_end) / chord,
             (derivative_at_begin + derivative_at_end - 2 * slope) / (chord * chord)},
            chord};
}

}  // namespace clsurf
