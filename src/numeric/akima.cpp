#include "numeric/akima.h"

#include <algorithm>
#include <cmath>

namespace clsurf {
namespace {

constexpr double even_weights = 1e-12;  ///< below it the slopes on both sides are equal: their mean is used

}  // namespace

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
        sink_(hermite(begin, begin + chord * slope, tangent_, tangent, chord));
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
    // Two extrapolated slopes: the tangents of the last two points (of the last one, if there are only two).
    for (std::size_t i = known_; i < points_; ++i) {
        push({last_, 2 * segments_[3].slope - segments_[2].slope, 0});
        take_tangent();
    }
}

std::vector<CubicSpan> akima_spans(std::span<const Vec3> points, AkimaTangents tangents) {
    std::vector<CubicSpan> spans;
    spans.reserve(points.size());
    AkimaStream stream([&](const CubicSpan& span) { spans.push_back(span); }, tangents);
    for (const Vec3& point : points) stream.add(point);
    stream.finish();
    return spans;
}

}  // namespace clsurf
