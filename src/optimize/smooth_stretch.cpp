#include "optimize/smooth_stretch.h"

#include <algorithm>
#include <numeric>

#include "curve/akima.h"
#include "curve/tube.h"

namespace clsurf {
namespace {

constexpr double knot_share =
    0.6;  ///< of the usual spacing: closer points are no knots of the curve that the search begins at
constexpr double knot_distance = 0.5;  ///< of the spacing between knots of the curve, at least

/// Akima's curve through some of the points, by the way along the old lines.
class Curve {
public:
    Curve(const std::vector<Vec3>& points, const std::vector<double>& ways, const std::vector<std::size_t>& knots) {
        std::vector<Vec3> through;
        for (const std::size_t k : knots) {
            through.push_back(points[k]);
            way_.push_back(ways[k]);
        }
        spans_ = akima_spans(through);
    }
    [[nodiscard]] Vec3 at(double way) const {
        const auto span =
            static_cast<std::size_t>(std::upper_bound(way_.begin() + 1, way_.end() - 1, way) - way_.begin()) - 1;
        return spans_[span].at(spans_[span].chord * (way - way_[span]) / (way_[span + 1] - way_[span]));
    }

private:
    std::vector<double> way_;
    std::vector<CubicSpan> spans_;
};

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

Curve smooth_curve(const OldStretch& old, const std::vector<StationOfPass>& stations, const LineRules& rules) {
    const Curve through_old(old.points, old.way, knots_of(old, knot_share * rules.usual));
    const std::vector<double> ways = ways_of_knots(old, stations, knot_distance * rules.spacing);
    std::vector<Vec3> places, start;
    for (const double way : ways) {
        places.push_back(old.at(way));
        start.push_back(way < old.length() ? through_old.at(way) : old.points.back());
    }
    std::vector<double> radii(ways.size(), rules.radius);
    // The ends keep their direction, too.
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}, ways.size() - 2, ways.size() - 1}) radii[k] = 0;
    std::vector<std::size_t> all(ways.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return {smoothest_in_tube(places, ways, radii, start), ways, all};
}

/// A point of the curve between its knots, no farther from the old lines about `way` than most of the tolerance.
Vec3 held(const Vec3& p, const OldStretch& old, double way, double most) {
    const Vec3 nearest = old.foot(p, way).position;
    const double off = (p - nearest).norm();
    return off > most ? Vec3(nearest + (p - nearest) * (most / off)) : p;
}

}  // namespace

SmoothStretch smooth(const OldStretch& old, const std::vector<StationOfPass>& stations, const LineRules& rules) {
    SmoothStretch result;
    result.way.push_back(0);
    for (const StationOfPass& s : stations) result.way.push_back(s.way);
    result.way.push_back(old.length());
    const Curve curve = smooth_curve(old, stations, rules);
    for (const double way : result.way) {
        result.places.push_back(old.at(way));
        result.points.push_back(way > 0 && way < old.length() ? held(curve.at(way), old, way, rules.most)
                                                              : result.places.back());
    }
    return result;
}

}  // namespace clsurf
