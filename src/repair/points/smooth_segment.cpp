#include "repair/points/smooth_segment.h"

#include <algorithm>

#include "numeric/akima.h"
#include "numeric/tube.h"

namespace clsurf {
namespace {

constexpr double knot_share = 0.6;     ///< share of the usual spacing: closer points are not knots of the initial curve
constexpr double knot_distance = 0.5;  ///< share of the spacing: least distance between knots of the curve

/// A place on spans whose knots are at given arc lengths, by linear interpolation of the parameter.
Vec3 at_arc_length(const std::vector<CubicSpan>& spans, const std::vector<double>& arc_lengths, double arc_length) {
    const auto span =
        static_cast<std::size_t>(std::upper_bound(arc_lengths.begin() + 1, arc_lengths.end() - 1, arc_length) -
                                 arc_lengths.begin()) -
        1;
    return spans[span].at(spans[span].chord * (arc_length - arc_lengths[span]) /
                          (arc_lengths[span + 1] - arc_lengths[span]));
}

/// Old points far enough apart to be knots, including both ends.
std::vector<std::size_t> knots_of(const OldSegment& old, double least) {
    std::vector<std::size_t> knots{0};
    const std::size_t last = old.points.size() - 1;
    for (std::size_t k = 1; k < last; ++k) {
        if (old.arc_length[k] - old.arc_length[knots.back()] >= least &&
            old.arc_length[last] - old.arc_length[k] >= least)
            knots.push_back(k);
    }
    knots.push_back(last);
    return knots;
}

/// Arc lengths of knots: the old points and the aligned points between them, including both ends, none too close to the next.
std::vector<double> arc_lengths_of_knots(const OldSegment& old, const std::vector<AlignedPoint>& aligned_points,
                                         double apart) {
    std::vector<double> arc_lengths{0};
    std::size_t next = 0;  // of the aligned points
    const auto take_aligned_points_before = [&](double limit) {
        for (; next < aligned_points.size() && aligned_points[next].arc_length < limit; ++next) {
            if (aligned_points[next].arc_length > arc_lengths.back() + apart)
                arc_lengths.push_back(aligned_points[next].arc_length);
        }
    };
    for (std::size_t k = 1; k + 1 < old.points.size(); ++k) {
        if (old.arc_length[k] < arc_lengths.back() + apart || old.arc_length[k] > old.length() - apart) continue;
        take_aligned_points_before(old.arc_length[k] - apart);
        arc_lengths.push_back(old.arc_length[k]);
    }
    take_aligned_points_before(old.length() - apart);
    arc_lengths.push_back(old.length());
    return arc_lengths;
}

/// A point of the curve between its knots, moved to within `most` of the old lines around `arc_length`.
Vec3 held(const Vec3& p, const OldSegment& old, double arc_length, double most) {
    const Vec3 nearest = old.projection(p, arc_length).position;
    const double off = (p - nearest).norm();
    return off > most ? Vec3(nearest + (p - nearest) * (most / off)) : p;
}

}  // namespace

SmoothCurve::SmoothCurve(const OldSegment& old, const std::vector<AlignedPoint>& aligned_points, const LineRules& rules)
    : old_(old),
      most_(rules.most),
      arc_length_(arc_lengths_of_knots(old, aligned_points, knot_distance * rules.spacing)) {
    std::vector<Vec3> through;
    std::vector<double> arc_lengths;
    for (const std::size_t k : knots_of(old, knot_share * rules.usual)) {
        through.push_back(old.points[k]);
        arc_lengths.push_back(old.arc_length[k]);
    }
    const std::vector<CubicSpan> through_old = akima_spans(through);
    std::vector<Vec3> places, start;
    for (const double arc_length : arc_length_) {
        places.push_back(old.at(arc_length));
        start.push_back(arc_length < old.length() ? at_arc_length(through_old, arc_lengths, arc_length)
                                                  : old.points.back());
    }
    std::vector<double> radii(arc_length_.size(), rules.radius);
    // The ends also keep their direction.
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}, arc_length_.size() - 2, arc_length_.size() - 1})
        radii[k] = 0;
    spans_ = akima_spans(smoothest_in_tube(places, arc_length_, radii, start));
}

Vec3 SmoothCurve::at(double arc_length) const {
    return arc_length > 0 && arc_length < old_.length()
               ? held(at_arc_length(spans_, arc_length_, arc_length), old_, arc_length, most_)
               : old_.at(arc_length);
}

SmoothSegment smooth(const OldSegment& old, const SmoothCurve& curve, const std::vector<AlignedPoint>& aligned_points) {
    SmoothSegment result;
    result.arc_length.push_back(0);
    for (const AlignedPoint& s : aligned_points) result.arc_length.push_back(s.arc_length);
    result.arc_length.push_back(old.length());
    for (const double arc_length : result.arc_length) {
        result.places.push_back(old.at(arc_length));
        result.points.push_back(curve.at(arc_length));
    }
    return result;
}

}  // namespace clsurf
