#include "optimize/resample.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "core/parallel.h"
#include "core/statistics.h"
#include "curve/akima.h"
#include "curve/polyline.h"
#include "curve/tube.h"
#include "optimize/stations.h"
#include "path/toolpath.h"

namespace clsurf {
namespace {

constexpr double knot_share = 0.6;        ///< of the usual spacing: closer points are no knots of the curve
constexpr double nearest_station = 0.35;  ///< of a line: a station nearer to a fixed point is left out
constexpr double narrowest = 0.3;         ///< of the tolerance: a tube for knots of the curve; …
constexpr double finest_share = 0.2;       ///< of the usual spacing
constexpr double line_reserve = 1.5;       ///< lines are one to two times as long as the shortest that they may be
constexpr std::int64_t passes_a_piece = 4;
constexpr double most_used = 0.99;        ///< … of what decimals leave of it, by lines
constexpr double knot_distance = 0.5;     ///< of the spacing between knots of the curve, at least
constexpr std::size_t reach_of_bends = 5; ///< stations to both sides whose bends a line's length fits
constexpr int parts = 4;                  ///< of a phase, that are told apart
constexpr double most_doublings = 6;      ///< of a part
constexpr std::size_t shortest_stretch = 3;  ///< motions

struct Spacings {
    double usual = 0;  ///< [mm] median
    double bend = 0;   ///< [1/mm] 98th percentile
};

/// What the chords of lines, as short as they may be, leave of what lines may leave the path by [mm].
double tube_radius(double most, const ResampleRules& rules, const Spacings& spacings) {
    const double shortest = line_reserve * rules.shortest_line, chord = std::max(rules.chord_error, spacings.bend * shortest * shortest / 8);
    return std::max(most - chord, narrowest * most);
}

/// One stretch of a pass between fixed points: its old points, and for each how far the way and the phase are.
struct Old {
    std::vector<Vec3> points;    ///< the first is where the stretch begins
    std::vector<double> way;     ///< [mm]
};

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
        const auto span = static_cast<std::size_t>(std::upper_bound(way_.begin() + 1, way_.end() - 1, way) - way_.begin()) - 1;
        return spans_[span].at(spans_[span].chord * (way - way_[span]) / (way_[span + 1] - way_[span]));
    }

private:
    std::vector<double> way_;
    std::vector<CubicSpan> spans_;
};

class Resampler {
public:
    Resampler(const Program& program, const ProgrammedSurface& laid, const LineEditor& editor, const ResampleRules& rules, const Spacings& spacings, std::span<const std::uint8_t> needed)
        : motions_(program.motions), path_(program.motions, Vec3::Zero()), laid_(laid), editor_(editor), rules_(rules), usual_(std::max(spacings.usual, rules.spacing)), most_(most_used * (rules.tolerance - editor.rounding())), radius_(tube_radius(most_, rules, spacings)), needed_(needed), phases_(run_phases(laid, rules.spacing)) {}

    [[nodiscard]] std::vector<Stretch> run() const {
        const std::vector<ProgrammedPass> passes = cut_passes(laid_);
        std::vector<std::vector<Stretch>> of_pass(passes.size());
        parallel_for(static_cast<std::int64_t>(passes.size()), passes_a_piece, [&](std::int64_t first, std::int64_t last) {
            for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(last); ++k) run_pass(passes[k], of_pass[k]);
        });
        std::vector<Stretch> stretches;
        for (std::vector<Stretch>& mine : of_pass) stretches.insert(stretches.end(), std::make_move_iterator(mine.begin()), std::make_move_iterator(mine.end()));
        return stretches;
    }

private:
    [[nodiscard]] std::uint32_t motion(PointIndex i) const { return laid_.motion_of(i); }

    /// Whether the line to end k of a pass may be rewritten as a whole.
    [[nodiscard]] bool editable(const ProgrammedPass& pass, std::size_t k) const {
        const std::uint32_t m = motion(pass.ends[k]);
        return (needed_.empty() || needed_[m] != 0) && editor_.editable(m) && laid_.ends_motion(pass.ends[k - 1]) && motion(pass.ends[k - 1]) + 1 == m;
    }

    void run_pass(const ProgrammedPass& pass, std::vector<Stretch>& stretches) const {
        std::size_t begin = 0;  // the end that the stretch begins at
        for (std::size_t k = 1; k < pass.ends.size(); ++k) {
            const bool may = editable(pass, k);
            const bool goes_on = k == begin + 1 || (may && motions_.line[motion(pass.ends[k])] == motions_.line[motion(pass.ends[k - 1])] + 1 && !turns(pass, k - 1));
            if (may && goes_on) continue;
            add(pass, begin, k - 1, stretches);
            begin = may ? k - 1 : k;
        }
        add(pass, begin, pass.ends.size() - 1, stretches);
    }

    /// Whether the path has a corner at end k.
    [[nodiscard]] bool turns(const ProgrammedPass& pass, std::size_t k) const {
        const Vec3 before = path_.end(motion(pass.ends[k])) - path_.begin(motion(pass.ends[k]));
        const Vec3 after = path_.end(motion(pass.ends[k + 1])) - path_.begin(motion(pass.ends[k + 1]));
        return before.dot(after) < std::cos(rules_.corner_angle) * before.norm() * after.norm();
    }

    /// Ends begin … end of a pass, both of which stay.
    void add(const ProgrammedPass& pass, std::size_t begin, std::size_t end, std::vector<Stretch>& stretches) const {
        if (end < begin + shortest_stretch) return;
        Old old;
        for (std::size_t k = begin; k <= end; ++k) {
            const Vec3 p = path_.end(motion(pass.ends[k]));
            old.way.push_back(old.points.empty() ? 0 : old.way.back() + (p - old.points.back()).norm());
            old.points.push_back(p);
        }
        if (old.way.back() < rules_.spacing) return;
        const Fine fine = smoothed(old, stations_of(pass.ends[begin], pass.ends[end], old.way.back()));
        Stretch stretch{motion(pass.ends[begin + 1]), motion(pass.ends[end]), {}};
        std::size_t from = 0;
        for (std::size_t k = 1; k < fine.points.size(); ++k) {
            if (!fine.kept[k]) continue;
            join(old, fine, from, k, stretch.points);
            from = k;
        }
        stretch.points.back() = old.points.back();
        if (!stays(old, stretch)) stretches.push_back(std::move(stretch));
    }

    /// A station: where on the way, and its phase in quarters.
    struct StationOfPass {
        double way = 0;
        std::int64_t number = 0;
        double part = 0;  ///< [mm] of way in a quarter
    };

    /// The curve at all stations of a stretch, its ends before and behind them.
    struct Fine {
        std::vector<double> way;
        std::vector<Vec3> places;        ///< on the old lines
        std::vector<Vec3> points;
        std::vector<std::uint8_t> kept;  ///< 0: the line from the kept point before to the next does without
    };

    [[nodiscard]] Fine smoothed(const Old& old, const std::vector<StationOfPass>& stations) const {
        Fine fine;
        fine.way.push_back(0);
        for (const StationOfPass& s : stations) fine.way.push_back(s.way);
        fine.way.push_back(old.way.back());
        const Curve curve = smooth_curve(old, stations);
        for (const double way : fine.way) {
            fine.places.push_back(on_lines(old, way));
            fine.points.push_back(way > 0 && way < old.way.back() ? held(curve.at(way), old, way) : fine.places.back());
        }
        choose(fine, stations);
        return fine;
    }

    /// The smoothest curve in the tube: its knots are the stations and the old points, at which the tube is narrowest.
    [[nodiscard]] Curve smooth_curve(const Old& old, const std::vector<StationOfPass>& stations) const {
        const Curve through_old(old.points, old.way, knots_of(old));
        const double apart = knot_distance * rules_.spacing, length = old.way.back();
        std::vector<double> ways{0};
        std::size_t next = 0;  // of the stations
        const auto take_stations_before = [&](double limit) {
            for (; next < stations.size() && stations[next].way < limit; ++next) {
                if (stations[next].way > ways.back() + apart) ways.push_back(stations[next].way);
            }
        };
        for (std::size_t k = 1; k + 1 < old.points.size(); ++k) {
            if (old.way[k] < ways.back() + apart || old.way[k] > length - apart) continue;
            take_stations_before(old.way[k] - apart);
            ways.push_back(old.way[k]);
        }
        take_stations_before(length - apart);
        ways.push_back(length);
        std::vector<Vec3> places, start;
        for (const double way : ways) {
            places.push_back(on_lines(old, way));
            start.push_back(way < length ? through_old.at(way) : old.points.back());
        }
        std::vector<double> radii(ways.size(), radius_);
        // The ends keep their direction, too.
        for (const std::size_t k : {std::size_t{0}, std::size_t{1}, ways.size() - 2, ways.size() - 1}) radii[k] = 0;
        std::vector<std::size_t> all(ways.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        return Curve(smoothest_in_tube(places, ways, radii, start), ways, all);
    }

    /// A point of the curve between its knots, no farther from the old lines about `way` than most of the tolerance.
    [[nodiscard]] Vec3 held(const Vec3& p, const Old& old, double way) const {
        const auto line = static_cast<std::size_t>(std::upper_bound(old.way.begin() + 1, old.way.end() - 1, way) - old.way.begin()) - 1;
        Vec3 nearest = nearest_on_line(p, old.points[line], old.points[line + 1]);
        const std::size_t first = line >= 2 ? line - 2 : 0, last = std::min(line + 3, old.points.size() - 1);
        for (std::size_t k = first; k < last; ++k) {
            const Vec3 q = nearest_on_line(p, old.points[k], old.points[k + 1]);
            if ((q - p).squaredNorm() < (nearest - p).squaredNorm()) nearest = q;
        }
        const double off = (p - nearest).norm(), most = most_;
        return off > most ? Vec3(nearest + (p - nearest) * (most / off)) : p;
    }

    /// Keeps the stations that lines need which leave the curve by no more than the chord error; which, hangs on
    /// the number of the station, so that neighbour passes keep the same.
    void choose(Fine& fine, const std::vector<StationOfPass>& stations) const {
        const std::size_t n = fine.points.size();
        fine.kept.assign(n, 1);
        std::vector<double> bend(n, 0);
        for (std::size_t k = 1; k + 1 < n; ++k) bend[k] = three_point_curvature(fine.points[k - 1], fine.points[k], fine.points[k + 1]);
        for (std::size_t k = 1; k + 1 < n; ++k) {
            double most = 0;
            const std::size_t first = k > reach_of_bends ? k - reach_of_bends : 0, last = std::min(k + reach_of_bends, n - 1);
            for (std::size_t j = first; j <= last; ++j) most = std::max(most, bend[j]);
            const double wanted = most > 0 ? std::min(std::sqrt(8 * rules_.chord_error / most), usual_) : usual_;
            const int level = level_of(wanted, stations[k - 1].part);
            const double line = std::ldexp(stations[k - 1].part, level), to_end = std::min(fine.way[k], fine.way.back() - fine.way[k]);
            const bool stump = to_end < std::max(rules_.shortest_line, nearest_station * line);
            fine.kept[k] = !stump && stations[k - 1].number % (std::int64_t{1} << level) == 0 ? 1 : 0;
        }
    }

    /// How often a part [mm] is doubled to become a line of up to `wanted` [mm], and not too short a one.
    [[nodiscard]] int level_of(double wanted, double part) const {
        const double coarsest = std::floor(std::log2(std::max(wanted / part, 1.0))), finest = std::ceil(std::log2(std::max(rules_.shortest_line / part, 1.0)));
        return static_cast<int>(std::clamp(std::max(coarsest, finest), 0.0, most_doublings));
    }

    /// The point at k, and before it those between it and the point `from` that the line needs to pass the old
    /// lines closely enough.
    void join(const Old& old, const Fine& fine, std::size_t from, std::size_t k, std::vector<Vec3>& points) const {
        if (k == from + 1) {
            pass_old_points(old, {fine.way[from], fine.points[from]}, {fine.way[k], fine.points[k]}, points);
            points.push_back(fine.points[k]);
            return;
        }
        double farthest = farthest_old_point(old, {fine.way[from], fine.points[from]}, {fine.way[k], fine.points[k]}).distance;
        for (std::size_t i = from + 1; i < k; ++i) farthest = std::max(farthest, (fine.places[i] - nearest_on_line(fine.places[i], fine.points[from], fine.points[k])).norm());
        if (farthest <= most_) {
            points.push_back(fine.points[k]);
            return;
        }
        const std::size_t middle = (from + k) / 2;
        join(old, fine, from, middle, points);
        join(old, fine, middle, k, points);
    }

    struct Place {
        double way = 0;
        Vec3 position = Vec3::Zero();
    };
    struct OldPoint {
        std::size_t index = 0;
        double distance = 0;  ///< [mm] from a line
        Vec3 foot = Vec3::Zero();  ///< on the line
    };

    /// Of the old points between two places the one farthest from the line between them.
    [[nodiscard]] static OldPoint farthest_old_point(const Old& old, const Place& from, const Place& to) {
        OldPoint found;
        for (auto i = static_cast<std::size_t>(std::upper_bound(old.way.begin(), old.way.end(), from.way) - old.way.begin()); i < old.way.size() && old.way[i] < to.way; ++i) {
            const Vec3 foot = nearest_on_line(old.points[i], from.position, to.position);
            if (const double off = (old.points[i] - foot).norm(); off > found.distance) found = {i, off, foot};
        }
        return found;
    }

    /// Between two places, points beside old ones that the line between them would leave too far off.
    void pass_old_points(const Old& old, const Place& from, const Place& to, std::vector<Vec3>& points) const {
        const OldPoint farthest = farthest_old_point(old, from, to);
        if (farthest.distance <= most_) return;
        const Vec3& left = old.points[farthest.index];
        const Place middle{old.way[farthest.index], left + (farthest.foot - left) * (radius_ / farthest.distance)};
        pass_old_points(old, from, middle, points);
        points.push_back(middle.position);
        pass_old_points(old, middle, to, points);
    }

    /// Stations between two points of the surface, from a margin behind the first to one before the last. Where passes fan
    /// out, halves and quarters of a phase are stations, too.
    [[nodiscard]] std::vector<StationOfPass> stations_of(PointIndex first, PointIndex last, double length) const {
        std::vector<StationOfPass> stations;
        const double margin = nearest_station * rules_.spacing;
        double way = 0;
        for (PointIndex i = first + 1; i <= last; ++i) {
            const double step = (laid_.surface.positions[i] - laid_.surface.positions[i - 1]).norm(), begin = way;
            way += step;
            const double a = parts * phases_.of_point[static_cast<std::size_t>(i - 1)], b = parts * phases_.of_point[static_cast<std::size_t>(i)];
            if (!(a == a) || !(b == b) || a == b) continue;
            const double part = step / std::abs(b - a);
            const std::int64_t every = parts * part > 2.8 * rules_.spacing ? 1 : parts * part > 1.4 * rules_.spacing ? 2 : 4;
            const auto low = static_cast<std::int64_t>(std::ceil(std::min(a, b))), high = static_cast<std::int64_t>(std::ceil(std::max(a, b)));
            for (std::int64_t k = low; k < high; ++k) {
                const std::int64_t number = a < b ? k : high - 1 - (k - low);
                if (number % every != 0) continue;
                const double at = begin + step * (static_cast<double>(number) - a) / (b - a);
                const double before = stations.empty() ? 0 : stations.back().way;
                if (at > std::max(margin, before + 0.5 * margin) && at < length - margin) stations.push_back({at, number, part});
            }
        }
        return stations;
    }

    /// Old points far enough apart to be knots, both ends among them.
    [[nodiscard]] std::vector<std::size_t> knots_of(const Old& old) const {
        const double least = knot_share * usual_;
        std::vector<std::size_t> knots{0};
        const std::size_t last = old.points.size() - 1;
        for (std::size_t k = 1; k < last; ++k) {
            if (old.way[k] - old.way[knots.back()] >= least && old.way[last] - old.way[k] >= least) knots.push_back(k);
        }
        knots.push_back(last);
        return knots;
    }

    /// The programmed path after `way`.
    [[nodiscard]] static Vec3 on_lines(const Old& old, double way) {
        const auto line = static_cast<std::size_t>(std::upper_bound(old.way.begin() + 1, old.way.end() - 1, way) - old.way.begin()) - 1;
        const double length = old.way[line + 1] - old.way[line];
        return length > 0 ? Vec3(old.points[line] + (old.points[line + 1] - old.points[line]) * ((way - old.way[line]) / length)) : old.points[line];
    }

    /// The points are the old ones already.
    [[nodiscard]] static bool stays(const Old& old, const Stretch& stretch) {
        if (stretch.points.size() + 1 != old.points.size()) return false;
        for (std::size_t k = 0; k < stretch.points.size(); ++k) {
            if ((stretch.points[k] - old.points[k + 1]).norm() > 1e-3) return false;
        }
        return true;
    }

    const Motions& motions_;
    Toolpath path_;
    const ProgrammedSurface& laid_;
    const LineEditor& editor_;
    const ResampleRules& rules_;
    double usual_;                           ///< [mm] spacing of the program's points, and how long lines get at most
    double most_;                            ///< [mm] that lines may leave the old ones by, before they are rounded
    double radius_;                          ///< [mm] of the tube: what chords leave of the tolerance
    std::span<const std::uint8_t> needed_;   ///< one entry a motion, or none
    Phases phases_;
};

Spacings spacings_of(const Program& program, const ProgrammedSurface& laid) {
    const Toolpath path(program.motions, Vec3::Zero());
    std::vector<double> lengths, bends;
    for (const ProgrammedPass& pass : cut_passes(laid)) {
        for (std::size_t k = 1; k < pass.ends.size(); ++k) {
            const std::uint32_t m = laid.motion_of(pass.ends[k]);
            lengths.push_back(path.length(m));
            if (k + 1 == pass.ends.size() || k < 2) continue;
            const std::uint32_t after = laid.motion_of(pass.ends[k + 1]);
            // Rounded words make short lines look bent.
            if (path.length(m) > 0.05 && path.length(after) > 0.05) bends.push_back(three_point_curvature(path.begin(m), path.end(m), path.end(after)));
        }
    }
    return {lengths.empty() ? 0 : quantile_below(lengths, 0.5), bends.empty() ? 0 : quantile_below(bends, 0.98)};
}

double fitting(const Spacings& spacings, double chord_error) {
    const double by_bend = spacings.bend > 0 ? std::sqrt(8 * chord_error / spacings.bend) : spacings.usual;
    return spacings.usual > 0 ? std::clamp(by_bend, finest_share * spacings.usual, spacings.usual) : by_bend;
}

}  // namespace

double fitting_spacing(const Program& program, const ProgrammedSurface& laid, double chord_error) {
    return fitting(spacings_of(program, laid), chord_error);
}

std::vector<Stretch> resample(const Program& program, const ProgrammedSurface& laid, const LineEditor& editor, const ResampleRules& wanted, std::span<const std::uint8_t> needed) {
    const Spacings spacings = spacings_of(program, laid);
    ResampleRules rules = wanted;
    if (rules.spacing <= 0) rules.spacing = fitting(spacings, rules.chord_error);
    if (rules.spacing <= 0 || rules.tolerance <= editor.rounding()) return {};
    return Resampler(program, laid, editor, rules, spacings, needed).run();
}

}  // namespace clsurf
