#include "repair/points/smooth_segment.h"

#include <algorithm>

#include "numeric/akima.h"
#include "numeric/tube.h"

namespace clsurf {
namespace {

constexpr double knot_share =
    0.6;  ///< of the usual spacing: closer points are no knots of the curve that the search begins at
constexpr double knot_distance = 0.5;  ///< of the spacing between knots of the curve, at least

/// A place on spans whose knots lie at some ways, by linear shares of those.
Vec3 at_way(const std::vector<CubicSpan>& spans, const std::vector<double>& ways, double way) {
    const auto span =
        static_cast<std::size_t>(std::upper_bound(ways.begin() + 1, ways.end() - 1, way) - ways.begin()) - 1;
    return spans[span].at(spans[span].chord * (way - ways[span]) / (ways[span + 1] - ways[span]));
}

/// Old points far enough apart to be knots, both ends among them.
std::vector<std::size_t> knots_of(const OldStretch& old, double least) {
    std::vector<std::size_t> knots{0};
    const std::size_t last = old.points.size() - 1;
    for (std::size_t k = 1; k < last; ++k) {
        if (old.way[k] - old.way[knots.back()] >= least && old.way[last] - old.way[k] >= least) knots.push_back(k);
    }
    knots.push_back(last);
    return knots;
}

/// Where knots are: the old points and the stations between them, both ends, none too near to the next.
std::vector<double> ways_of_knots(const OldStretch& old, const std::vector<StationOfPass>& stations, double apart) {
    std::vector<double> ways{0};
    std::size_t next = 0;  // of the stations
    const auto take_stations_before = [&](double limit) {
        for (; next < stations.size() && stations[next].way < limit; ++next) {
            if (stations[next].way > ways.back() + apart) ways.push_back(stations[next].way);
        }
    };
    for (std::size_t k = 1; k + 1 < old.points.size(); ++k) {
        if (old.way[k] < ways.back() + apart || old.way[k] > old.length() - apart) continue;
        take_stations_before(old.way[k] - apart);
        ways.push_back(old.way[k]);
    }
    take_stations_before(old.length() - apart);
    ways.push_back(old.length());
    return ways;
}

/// A point of the curve between its knots, no farther from the old lines about `way` than most of the tolerance.
Vec3 held(const Vec3& p, const OldStretch& old, double way, double most) {
    const Vec3 nearest = old.foot(p, way).position;
    const double off = (p - nearest).norm();
    return off > most ? Vec3(nearest + (p - nearest) * (most / off)) : p;
}

}  // namespace

SmoothCurve::SmoothCurve(const OldStretch& old, const std::vector<StationOfPass>& stations, const LineRules& rules)
    : old_(old), most_(rules.most), way_(ways_of_knots(old, stations, knot_distance * rules.spacing)) {
    std::vector<Vec3> through;
    std::vector<double> ways;
    for (const std::size_t k : knots_of(old, knot_share * rules.usual)) {
        through.push_back(old.points[k]);
        ways.push_back(old.way[k]);
    }
    const std::vector<CubicSpan> through_old = akima_spans(through);
    std::vector<Vec3> places, start;
    for (const double way : way_) {
        places.push_back(old.at(way));
        start.push_back(way < old.length() ? at_way(through_old, ways, way) : old.points.back());
    }
    std::vector<double> radii(way_.size(), rules.radius);
    // The ends keep their direction, too.
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}, way_.size() - 2, way_.size() - 1}) radii[k] = 0;
    spans_ = akima_spans(smoothest_in_tube(places, way_, radii, start));
}

Vec3 SmoothCurve::at(double way) const {
    return way > 0 && way < old_.length() ? held(at_way(spans_, way_, way), old_, way, most_) : old_.at(way);
}

SmoothStretch smooth(const OldStretch& old, const std::vector<StationOfPass>& stations, const LineRules& rules) {
    SmoothStretch result;
    result.way.push_back(0);
    for (const StationOfPass& s : stations) result.way.push_back(s.way);
    result.way.push_back(old.length());
    const SmoothCurve curve(old, stations, rules);
    for (const double way : result.way) {
        result.places.push_back(old.at(way));
        result.points.push_back(curve.at(way));
    }
    return result;
}

}  // namespace clsurf
