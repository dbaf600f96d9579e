#include "curve/akima.h"

#include <algorithm>
#include <cmath>

namespace clsurf {
namespace {

constexpr double even_weights = 1e-12;   ///< below it the slopes on both sides do not change: their mean
constexpr double way_exact = 1e-12;      ///< of the chord: where Newton's steps end
constexpr int most_steps = 60;

}  // namespace

Vec3 AkimaSpan::at(double u) const {
    return coefficients[0] + u * (coefficients[1] + u * (coefficients[2] + u * coefficients[3]));
}

Vec3 AkimaSpan::derivative(double u) const {
    return coefficients[1] + u * (2 * coefficients[2] + 3 * u * coefficients[3]);
}

double AkimaSpan::way_to(double u) const {
    static constexpr std::array<double, 5> node{0, -0.5384693101056831, 0.5384693101056831, -0.9061798459386640, 0.9061798459386640};
    static constexpr std::array<double, 5> weight{0.5688888888888889, 0.4786286704993665, 0.4786286704993665, 0.2369268850561891, 0.2369268850561891};
    double sum = 0;
    for (std::size_t k = 0; k < node.size(); ++k) sum += weight[k] * derivative(0.5 * u * (1 + node[k])).norm();
    return 0.5 * u * sum;
}

double AkimaSpan::at_way(double way) const {
    double low = 0, high = chord;
    if (way <= 0) return low;
    if (way >= way_to(chord)) return high;
    double u = chord * way / way_to(chord);
    for (int step = 0; step < most_steps; ++step) {
        const double over = way_to(u) - way;
        if (std::abs(over) <= way_exact * chord) break;
        (over > 0 ? high : low) = u;
        const double speed = derivative(u).norm();
        const double next = speed > 0 ? u - over / speed : high;
        u = next > low && next < high ? next : 0.5 * (low + high);
    }
    return u;
}

Vec3 akima_tangent(const Vec3& before_2, const Vec3& before_1, const Vec3& behind_1, const Vec3& behind_2) {
    const double of_before = (behind_2 - behind_1).norm();
    const double of_behind = (before_1 - before_2).norm();
    const double sum = of_before + of_behind;
    if (sum < even_weights) return 0.5 * (before_1 + behind_1);
    return (of_before * before_1 + of_behind * behind_1) / sum;
}

void AkimaStream::push(const Segment& segment) {
    std::rotate(segments_.begin(), segments_.begin() + 1, segments_.end());
    segments_.back() = segment;
}

void AkimaStream::add(const Vec3& point) {
    if (points_++ > 0) {
        const double chord = (point - last_).norm();
        push({last_, (point - last_) / chord, chord});
        if (points_ == 3) extrapolate_before();
        if (points_ >= 3) take_tangent();
    }
    last_ = point;
}

void AkimaStream::extrapolate_before() {
    segments_[1].slope = 2 * segments_[2].slope - segments_[3].slope;
    segments_[0].slope = 2 * segments_[1].slope - segments_[2].slope;
}

void AkimaStream::take_tangent() {
    Vec3 tangent = akima_tangent(segments_[0].slope, segments_[1].slope, segments_[2].slope, segments_[3].slope);
    if (tangents_ == AkimaTangents::unit && tangent.norm() > 0) tangent.normalize();
    if (known_++ > 0) {
        const auto& [begin, slope, chord] = segments_[1];
        sink_({{begin, tangent_, (3 * slope - 2 * tangent_ - tangent) / chord, (tangent_ + tangent - 2 * slope) / (chord * chord)}, chord});
    }
    tangent_ = tangent;
}

void AkimaStream::finish() {
    if (points_ < 2) return;
    if (points_ == 2) {
        push({last_, segments_[3].slope, 0});  // straight on
        extrapolate_before();
        take_tangent();
    }
    // Two slopes more: the tangents of the last two points (of the last one, where there are but two).
    for (std::size_t i = known_; i < points_; ++i) {
        push({last_, 2 * segments_[3].slope - segments_[2].slope, 0});
        take_tangent();
    }
}

std::vector<AkimaSpan> akima_spans(std::span<const Vec3> points, AkimaTangents tangents) {
    std::vector<AkimaSpan> spans;
    spans.reserve(points.size());
    AkimaStream stream([&](const AkimaSpan& span) { spans.push_back(span); }, tangents);
    for (const Vec3& point : points) stream.add(point);
    stream.finish();
    return spans;
}

}  // namespace clsurf
