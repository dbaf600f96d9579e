#include "numeric/bezier_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace clsurf {
namespace {

using WeightedPoint = BezierCurve::Weighted;

constexpr std::size_t least_curve_pieces = 4, most_curve_pieces = 256;
constexpr double curve_length_exact = 1e-10;  ///< greatest relative change of the length if the pieces are doubled
constexpr int most_newton_steps = 40;
constexpr double parameter_exact = 1e-14;
constexpr double arc_length_rounding = 1e-13;  ///< relative to the length
constexpr double no_speed = 1e-7;              ///< relative to the length: a smaller derivative has no direction
constexpr double stop_offset = 1e-4;           ///< offset in t at which the direction is taken instead
constexpr int most_splits = 16;

/// de Casteljau's scheme over control points.
struct Scheme {
    std::array<WeightedPoint, most_bezier_degree + 1> h;
    int count;

    explicit Scheme(const std::vector<WeightedPoint>& points) : count(static_cast<int>(points.size())) {
        std::copy(points.begin(), points.end(), h.begin());
    }
    /// Reduces to `left` points.
    void reduce(double t, int left) {
        for (; count > left; --count) {
            for (std::size_t i = 0; i + 1 < static_cast<std::size_t>(count); ++i) h[i] = (1 - t) * h[i] + t * h[i + 1];
        }
    }
    /// Replaces the points by their differences.
    void differ() {
        --count;
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) h[i] = h[i + 1] - h[i];
    }
};

/// Distance of a point from a chord.
double distance_from_chord(const Vec3& p, const Vec3& begin, const Vec3& end) {
    const Vec3 along = end - begin;
    const double square = along.squaredNorm();
    const double part = square > 0 ? std::clamp((p - begin).dot(along) / square, 0.0, 1.0) : 0.0;
    return (begin + part * along - p).norm();
}

}  // namespace

BezierCurve::BezierCurve(std::span<const Vec3> points, std::span<const double> weights) : origin_(points.front()) {
    points_.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double w = weights.empty() ? 1.0 : weights[i];
        const Vec3 p = w * (points[i] - origin_);
        points_.emplace_back(p.x(), p.y(), p.z(), w);
    }
    measure();
}

BezierCurve::BezierCurve(const Vec3& origin, std::vector<Weighted> points)
    : origin_(origin), points_(std::move(points)) {
    measure();
}

Vec3 BezierCurve::at(double t) const {
    Scheme scheme(points_);
    scheme.reduce(t, 1);
    return origin_ + scheme.h[0].head<3>() / scheme.h[0][3];
}

CurveJet BezierCurve::jet(double t) const {
    // With four points left in the scheme, derivatives are their differences at t.
    const int n = degree();
    Scheme rest(points_);
    rest.reduce(t, std::min(n, 3) + 1);
    std::array<WeightedPoint, 4> h;
    double factor = 1;
    for (int order = 0; order < 4; ++order) {
        if (order > n) {
            h[static_cast<std::size_t>(order)].setZero();
            continue;
        }
        Scheme value = rest;
        value.reduce(t, 1);
        h[static_cast<std::size_t>(order)] = factor * value.h[0];
        factor *= n - order;
        if (rest.count > 1) rest.differ();
    }
    const double w = h[0][3];
    const Vec3 c = h[0].head<3>() / w;
    CurveJet jet;
    jet.at = origin_ + c;
    jet.first = (h[1].head<3>() - h[1][3] * c) / w;
    jet.second = (h[2].head<3>() - 2 * h[1][3] * jet.first - h[2][3] * c) / w;
    jet.third = (h[3].head<3>() - 3 * h[1][3] * jet.second - 3 * h[2][3] * jet.first - h[3][3] * c) / w;
    return jet;
}

CurveJet BezierCurve::moving_jet(double t) const {
    const CurveJet here = jet(t);
    if (here.first.norm() > no_speed * length()) return here;
    return jet(t < 0.5 ? t + stop_offset : t - stop_offset);
}

Vec3 BezierCurve::tangent(double t) const { return moving_jet(t).first.normalized(); }

std::optional<std::pair<double, double>> BezierCurve::sharp_turn(double within) const {
    constexpr double may_hide_one = 0.5;  // cosine of the turn between two entries of the table
    constexpr int halvings = 60;
    if (!(length() > within)) return std::nullopt;
    const auto speed = [&](double t) { return jet(t).first.squaredNorm(); };
    Vec3 before = tangent(0);
    for (std::size_t piece = 1; piece < knots_.size(); ++piece) {
        const Vec3 after = tangent(stepped(piece));
        const bool is_examined = before.dot(after) < may_hide_one;
        before = after;
        if (!is_examined) continue;
        // The direction turns fastest at the smallest derivative.
        double low = stepped(piece - 1), high = stepped(piece);
        for (int k = 0; k < halvings; ++k) {
            const double third = (high - low) / 3;
            if (speed(low + third) < speed(high - third))
                high -= third;
            else
                low += third;
        }
        const double place = 0.5 * (low + high), here = arc_length_to(place);
        const double from = at_arc_length(here - 0.5 * within), to = at_arc_length(here + 0.5 * within);
        if (here > within && length() - here > within && tangent(from).dot(tangent(to)) < 0) return std::pair(from, to);
    }
    return std::nullopt;
}

std::pair<BezierCurve, BezierCurve> BezierCurve::split_at(double t) const {
    std::vector<Weighted> first, second(points_.size());
    Scheme scheme(points_);
    while (scheme.count > 0) {
        const auto last = static_cast<std::size_t>(scheme.count) - 1;
        first.push_back(scheme.h[0]);
        second[last] = scheme.h[last];
        scheme.reduce(t, scheme.count - 1);
    }
    return {BezierCurve(origin_, std::move(first)), BezierCurve(origin_, std::move(second))};
}

/// Arc length from one parameter to another, by Gauss's rule with 5 points.
double BezierCurve::gauss(double from, double to) const {
    static constexpr std::array<double, 5> node{0, -0.5384693101056831, 0.5384693101056831, -0.9061798459386640,
                                                0.9061798459386640};
    static constexpr std::array<double, 5> weight{0.5688888888888889, 0.4786286704993665, 0.4786286704993665,
                                                  0.2369268850561891, 0.2369268850561891};
    const double half = 0.5 * (to - from), middle = 0.5 * (to + from);
    double sum = 0;
    for (std::size_t k = 0; k < node.size(); ++k) sum += weight[k] * jet(middle + half * node[k]).first.norm();
    return half * sum;
}

void BezierCurve::measure() {
    double before = -1;
    for (std::size_t pieces = least_curve_pieces; pieces <= most_curve_pieces; pieces *= 2) {
        knots_.assign(pieces + 1, {at(0), 0});
        for (std::size_t k = 1; k <= pieces; ++k) {
            knots_[k].point = at(stepped(k));
            knots_[k].arc_length = knots_[k - 1].arc_length + gauss(stepped(k - 1), stepped(k));
        }
        if (!(std::abs(length() - before) > curve_length_exact * length())) return;
        before = length();
    }
}

double BezierCurve::arc_length_to(double t) const {
    if (t <= 0) return 0;
    if (t >= 1) return length();
    const auto piece =
        std::min(static_cast<std::size_t>(t * static_cast<double>(knots_.size() - 1)), knots_.size() - 2);
    return knots_[piece].arc_length + gauss(stepped(piece), t);
}

double BezierCurve::at_arc_length(double arc_length) const {
    if (!(arc_length > 0)) return 0;
    if (arc_length >= length()) return 1;
    const auto behind = std::upper_bound(knots_.begin(), knots_.end(), arc_length,
                                         [](double value, const Knot& knot) { return value < knot.arc_length; });
    const auto piece = std::min(static_cast<std::size_t>(behind - knots_.begin()) - 1, knots_.size() - 2);
    const double begin = stepped(piece);
    const double there = knots_[piece].arc_length, piece_length = knots_[piece + 1].arc_length - there;
    double low = begin, high = stepped(piece + 1);
    double t = piece_length > 0 ? begin + (high - low) * (arc_length - there) / piece_length : begin;
    for (int step = 0; step < most_newton_steps; ++step) {
        const double over = there + gauss(begin, t) - arc_length;
        if (std::abs(over) <= arc_length_rounding * length()) break;
        (over > 0 ? high : low) = t;
        const double speed = jet(t).first.norm();
        const double next = speed > 0 ? t - over / speed : high;
        const double inside = next > low && next < high ? next : 0.5 * (low + high);
        if (std::abs(inside - t) <= parameter_exact) break;
        t = inside;
    }
    return t;
}

double BezierCurve::turning() const {
    double sum = 0;
    Vec3 before = tangent(0);
    const std::size_t places = 4 * (knots_.size() - 1);
    for (std::size_t k = 1; k <= places; ++k) {
        const Vec3 here = tangent(static_cast<double>(k) / static_cast<double>(places));
        sum += angle_between(before, here);
        before = here;
    }
    return sum;
}

BezierCurve::Nearest BezierCurve::nearest(const Vec3& p, double from) const {
    // The nearest chord of the table, then Newton's method.
    Nearest best{from, std::numeric_limits<double>::infinity()};
    const auto take = [&](double t) {
        const double distance = (at(t) - p).norm();
        if (distance < best.distance) best = {t, distance};
    };
    double low = from, high = 1, t = from, nearest_chord = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + 1 < knots_.size(); ++k) {
        if (stepped(k + 1) <= from) continue;
        const Vec3 along = knots_[k + 1].point - knots_[k].point;
        const double square = along.squaredNorm();
        const double part = square > 0 ? std::clamp((p - knots_[k].point).dot(along) / square, 0.0, 1.0) : 0.0;
        const double distance = (knots_[k].point + part * along - p).squaredNorm();
        if (!(distance < nearest_chord)) continue;
        nearest_chord = distance;
        t = stepped(k) + part * (stepped(k + 1) - stepped(k));
        low = std::max(from, k == 0 ? 0.0 : stepped(k - 1));
        high = std::min(1.0, k + 2 < knots_.size() ? stepped(k + 2) : 1.0);
    }
    t = std::clamp(t, low, high);
    for (int step = 0; step < most_newton_steps; ++step) {
        const CurveJet c = jet(t);
        const Vec3 off = c.at - p;
        const double slope = off.dot(c.first);
        const double bend = c.first.squaredNorm() + off.dot(c.second);
        (slope > 0 ? high : low) = t;
        const double next = bend > 0 ? t - slope / bend : slope > 0 ? low : high;
        const double inside = next >= low && next <= high ? next : 0.5 * (low + high);
        if (std::abs(inside - t) <= 1e-12) break;
        t = inside;
    }
    take(t);
    take(from);
    take(1);
    return best;
}

namespace {

/// A half of a curve, by de Casteljau's scheme: the first points of its rows, or the last ones.
std::vector<WeightedPoint> half_of(const std::vector<WeightedPoint>& points, bool second) {
    std::vector<WeightedPoint> half, row = points;
    while (!row.empty()) {
        half.push_back(second ? row.back() : row.front());
        for (std::size_t i = 0; i + 1 < row.size(); ++i) row[i] = 0.5 * (row[i] + row[i + 1]);
        row.pop_back();
    }
    if (second) std::reverse(half.begin(), half.end());
    return half;
}

/// Upper bound of the distance of a curve from its chord: that of its control points; for polynomials of degrees 2 and
/// 3 a fraction of it.
double bound_off_chord(const std::vector<WeightedPoint>& h) {
    const auto point = [&](std::size_t i) { return Vec3(h[i].head<3>() / h[i][3]); };
    const Vec3 begin = point(0), end = point(h.size() - 1);
    double off = 0;
    bool rational = false;
    for (std::size_t i = 1; i + 1 < h.size(); ++i) {
        if (!(h[i][3] > 0)) return std::numeric_limits<double>::infinity();
        rational = rational || h[i][3] != h[0][3];
        off = std::max(off, distance_from_chord(point(i), begin, end));
    }
    rational = rational || h.back()[3] != h[0][3];
    return off * (rational ? 1.0 : h.size() == 3 ? 0.5 : h.size() == 4 ? 0.75 : 1.0);
}

void add_chords(const std::vector<WeightedPoint>& h, double from, double to, double error, int depth,
                std::vector<double>& ends) {
    if (!(bound_off_chord(h) > error) || depth == most_splits) {
        ends.push_back(to);
        return;
    }
    const double middle = 0.5 * (from + to);
    add_chords(half_of(h, false), from, middle, error, depth + 1, ends);
    add_chords(half_of(h, true), middle, to, error, depth + 1, ends);
}

}  // namespace

std::vector<double> BezierCurve::chord_ends(double error) const {
    std::vector<double> ends;
    add_chords(points_, 0, 1, error, 0, ends);
    return ends;
}

bool BezierCurve::same_as(const BezierCurve& other, double tolerance) const {
    if (points_.size() != other.points_.size()) return false;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const Vec3 off = point(i) - other.point(i);
        if ((off.array().abs() > tolerance).any() || std::abs(weight(i) - other.weight(i)) > 1e-9) return false;
    }
    return true;
}

BezierCurve BezierCurve::with_unknown_at(const Vec3& rest) const {
    return mapped([&](const Vec3& p) { return Vec3(p.array().isNaN().select(rest, p)); });
}

BezierCurve BezierCurve::mapped(const std::function<Vec3(const Vec3&)>& map) const {
    // An affine map acts with its linear part on the weighted differences from the origin.
    const Vec3 origin = map(origin_);
    std::vector<Weighted> points;
    points.reserve(points_.size());
    for (const Weighted& p : points_) {
        const Vec3 moved = map(origin_ + p.head<3>()) - origin;
        points.emplace_back(moved.x(), moved.y(), moved.z(), p[3]);
    }
    return {origin, std::move(points)};
}

std::vector<NurbsSpan> spans_of(const Nurbs& nurbs) {
    const auto p = static_cast<std::size_t>(nurbs.degree);
    const std::vector<double>& t = nurbs.knots;
    const std::size_t count = nurbs.points.size();
    std::vector<NurbsSpan> spans;
    std::vector<WeightedPoint> d(p + 1);
    for (std::size_t i = p; i < count; ++i) {
        if (!(t[i + 1] > t[i])) continue;
        const Vec3 origin = nurbs.points[i - p];
        std::vector<WeightedPoint> points(p + 1);
        for (std::size_t j = 0; j <= p; ++j) {
            for (std::size_t k = 0; k <= p; ++k) {
                const std::size_t from = i - p + k;
                const double w = nurbs.weights.empty() ? 1.0 : nurbs.weights[from];
                const Vec3 q = w * (nurbs.points[from] - origin);
                d[k] = WeightedPoint(q.x(), q.y(), q.z(), w);
            }
            // The blossom at p − j times the beginning of the span and j times its end.
            for (std::size_t r = 1; r <= p; ++r) {
                const double u = r <= p - j ? t[i] : t[i + 1];
                for (std::size_t k = p; k >= r; --k) {
                    const double low = t[i - p + k], high = t[i + 1 + k - r];
                    const double part = (u - low) / (high - low);
                    d[k] = (1 - part) * d[k - 1] + part * d[k];
                }
            }
            points[j] = d[p];
        }
        spans.push_back({i, BezierCurve(origin, std::move(points))});
    }
    return spans;
}

std::vector<double> clamped_knots(int degree, std::span<const double> intervals) {
    std::vector<double> knots(static_cast<std::size_t>(degree) + 1, 0.0);
    for (const double interval : intervals) knots.push_back(knots.back() + interval);
    knots.insert(knots.end(), static_cast<std::size_t>(degree), knots.back());
    return knots;
}

BezierCurve bezier_of(std::span<const Vec3> coefficients, std::span<const double> denominator, double interval) {
    const std::size_t count = std::max({coefficients.size(), denominator.size(), std::size_t{2}});
    const auto n = static_cast<double>(count - 1);
    std::vector<WeightedPoint> h(count, WeightedPoint::Zero());
    const Vec3 origin = coefficients.empty() ? Vec3(Vec3::Zero()) : coefficients[0];
    // Power to Bernstein: b_j = Σ_i C(j, i)/C(n, i) a_i, with a_i of t = p/interval.
    double scale = 1;
    std::vector<double> choose_n(count, 1.0);
    for (std::size_t i = 1; i < count; ++i)
        choose_n[i] = choose_n[i - 1] * (n - static_cast<double>(i) + 1) / static_cast<double>(i);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 a = i < coefficients.size() ? coefficients[i] : Vec3(Vec3::Zero());
        const double b = i < denominator.size() ? denominator[i] : i == 0 ? 1.0 : 0.0;
        const Vec3 relative = a - b * origin;
        const WeightedPoint term = scale * WeightedPoint(relative.x(), relative.y(), relative.z(), b);
        double choose_j = 1;
        for (std::size_t j = i; j < count; ++j) {
            if (j > i) choose_j *= static_cast<double>(j) / static_cast<double>(j - i);
            h[j] += choose_j / choose_n[i] * term;
        }
        scale *= interval;
    }
    return {origin, std::move(h)};
}

}  // namespace clsurf
