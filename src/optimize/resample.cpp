#include "optimize/resample.h"

#include <algorithm>
#include <cmath>

#include "curve/akima.h"
#include "core/statistics.h"
#include "curve/polyline.h"
#include "optimize/stations.h"
#include "path/toolpath.h"

namespace clsurf {
namespace {

constexpr double knot_share = 0.6;        ///< of the spacing: closer points are no knots of the curve
constexpr double nearest_station = 0.35;  ///< of the spacing: a station nearer to a fixed point is left out
constexpr double rounding_reserve = 0.85;  ///< of the tolerance that is used: the rest is for the decimals
constexpr int most_halvings = 5;          ///< of a line between stations; then the old points come back
constexpr std::size_t shortest_stretch = 3;  ///< motions

/// One stretch of a pass between fixed points: its old points, and for each how far the way and the phase are.
struct Old {
    std::vector<Vec3> points;    ///< the first is where the stretch begins
    std::vector<double> way;     ///< [mm]
};

/// Akima's curve through some of the old points, by the way along the old lines.
class Curve {
public:
    Curve(const Old& old, const std::vector<std::size_t>& knots) {
        std::vector<Vec3> points;
        for (const std::size_t k : knots) {
            points.push_back(old.points[k]);
            way_.push_back(old.way[k]);
        }
        spans_ = akima_spans(points);
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
    Resampler(const Program& program, const ProgrammedSurface& laid, const LineEditor& editor, const ResampleRules& rules)
        : motions_(program.motions), path_(program.motions, Vec3::Zero()), laid_(laid), editor_(editor), rules_(rules), phases_(run_phases(laid, rules.spacing)) {}

    std::vector<Stretch> run() {
        for (const ProgrammedPass& pass : cut_passes(laid_)) run_pass(pass);
        return std::move(stretches_);
    }

private:
    [[nodiscard]] std::uint32_t motion(PointIndex i) const { return laid_.motion_of(i); }

    /// Whether the line to end k of a pass may be rewritten as a whole.
    [[nodiscard]] bool editable(const ProgrammedPass& pass, std::size_t k) const {
        const std::uint32_t m = motion(pass.ends[k]);
        return editor_.editable(m) && laid_.ends_motion(pass.ends[k - 1]) && motion(pass.ends[k - 1]) + 1 == m;
    }

    void run_pass(const ProgrammedPass& pass) {
        std::size_t begin = 0;  // the end that the stretch begins at
        for (std::size_t k = 1; k < pass.ends.size(); ++k) {
            const bool may = editable(pass, k);
            const bool goes_on = k == begin + 1 || (may && motions_.line[motion(pass.ends[k])] == motions_.line[motion(pass.ends[k - 1])] + 1 && !turns(pass, k - 1));
            if (may && goes_on) continue;
            add(pass, begin, k - 1);
            begin = may ? k - 1 : k;
        }
        add(pass, begin, pass.ends.size() - 1);
    }

    /// Whether the path has a corner at end k.
    [[nodiscard]] bool turns(const ProgrammedPass& pass, std::size_t k) const {
        const Vec3 before = path_.end(motion(pass.ends[k])) - path_.begin(motion(pass.ends[k]));
        const Vec3 after = path_.end(motion(pass.ends[k + 1])) - path_.begin(motion(pass.ends[k + 1]));
        return before.dot(after) < std::cos(rules_.corner_angle) * before.norm() * after.norm();
    }

    /// Ends begin … end of a pass, both of which stay.
    void add(const ProgrammedPass& pass, std::size_t begin, std::size_t end) {
        if (end < begin + shortest_stretch) return;
        Old old;
        for (std::size_t k = begin; k <= end; ++k) {
            const Vec3 p = path_.end(motion(pass.ends[k]));
            old.way.push_back(old.points.empty() ? 0 : old.way.back() + (p - old.points.back()).norm());
            old.points.push_back(p);
        }
        if (old.way.back() < rules_.spacing) return;
        const Curve curve(old, knots_of(old));
        Stretch stretch{motion(pass.ends[begin + 1]), motion(pass.ends[end]), {}};
        std::vector<double> stations = stations_of(pass.ends[begin], pass.ends[end]);
        stations.push_back(old.way.back());
        Place from{0, old.points.front()};
        for (const double way : stations) {
            const Place to{way, way < old.way.back() ? held(old, curve.at(way), way) : old.points.back()};
            refine(old, curve, from, to, most_halvings, stretch.points);
            stretch.points.push_back(to.position);
            from = to;
        }
        if (!stays(old, stretch)) stretches_.push_back(std::move(stretch));
    }

    struct Place {
        double way = 0;
        Vec3 position = Vec3::Zero();
    };

    /// Points between two places, where the line between them passes old points too far off.
    void refine(const Old& old, const Curve& curve, const Place& from, const Place& to, int halvings, std::vector<Vec3>& points) const {
        const auto first = static_cast<std::size_t>(std::upper_bound(old.way.begin(), old.way.end(), from.way) - old.way.begin());
        double farthest = 0;
        std::size_t at = first;
        for (std::size_t k = first; k < old.way.size() && old.way[k] < to.way; ++k) {
            const double off = (old.points[k] - nearest_on_line(old.points[k], from.position, to.position)).norm();
            if (off > farthest) farthest = off, at = k;
        }
        if (farthest <= rounding_reserve * rules_.tolerance) return;
        const double way = halvings > 0 ? 0.5 * (from.way + to.way) : old.way[at];
        const Place middle{way, halvings > 0 ? held(old, curve.at(way), way) : old.points[at]};
        refine(old, curve, from, middle, halvings - 1, points);
        points.push_back(middle.position);
        refine(old, curve, middle, to, halvings - 1, points);
    }

    /// Ways [mm] from the point `first` on where the phase passes a whole number.
    [[nodiscard]] std::vector<double> stations_of(PointIndex first, PointIndex last) const {
        std::vector<double> stations;
        std::vector<double> way{0};
        for (PointIndex i = first + 1; i <= last; ++i) way.push_back(way.back() + (laid_.surface.positions[i] - laid_.surface.positions[i - 1]).norm());
        const double margin = nearest_station * rules_.spacing;
        for (PointIndex i = first + 1; i <= last; ++i) {
            const auto k = static_cast<std::size_t>(i - first);
            const double a = phases_.of_point[static_cast<std::size_t>(i - 1)], b = phases_.of_point[static_cast<std::size_t>(i)];
            if (!(a == a) || !(b == b) || a == b) continue;
            const double low = std::min(a, b), high = std::max(a, b);
            std::vector<double> here;
            for (double n = std::ceil(low); n < high; ++n) here.push_back(way[k - 1] + (way[k] - way[k - 1]) * (n - a) / (b - a));
            if (b < a) std::reverse(here.begin(), here.end());
            for (const double s : here) {
                if (s > margin && s < way.back() - margin) stations.push_back(s);
            }
        }
        return stations;
    }

    /// Old points far enough apart to be knots, both ends among them.
    [[nodiscard]] std::vector<std::size_t> knots_of(const Old& old) const {
        const double least = knot_share * rules_.spacing;
        std::vector<std::size_t> knots{0};
        const std::size_t last = old.points.size() - 1;
        for (std::size_t k = 1; k < last; ++k) {
            if (old.way[k] - old.way[knots.back()] >= least && old.way[last] - old.way[k] >= least) knots.push_back(k);
        }
        knots.push_back(last);
        return knots;
    }

    /// A point no farther from the old lines about `way` than the tolerance leaves.
    [[nodiscard]] Vec3 held(const Old& old, const Vec3& p, double way) const {
        const auto line = static_cast<std::size_t>(std::upper_bound(old.way.begin() + 1, old.way.end() - 1, way) - old.way.begin()) - 1;
        Vec3 nearest = nearest_on_line(p, old.points[line], old.points[line + 1]);
        const std::size_t first = line >= 2 ? line - 2 : 0, last = std::min(line + 3, old.points.size() - 1);
        for (std::size_t k = first; k < last; ++k) {
            const Vec3 q = nearest_on_line(p, old.points[k], old.points[k + 1]);
            if ((q - p).squaredNorm() < (nearest - p).squaredNorm()) nearest = q;
        }
        const double off = (p - nearest).norm(), most = rounding_reserve * rules_.tolerance;
        return off > most ? nearest + (p - nearest) * (most / off) : p;
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
    Phases phases_;
    std::vector<Stretch> stretches_;
};

}  // namespace

double fitting_spacing(const Program& program, const ProgrammedSurface& laid, double tolerance) {
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
    const double usual = (lengths.empty() ? 0 : quantile_below(lengths, 0.5)), bend = (bends.empty() ? 0 : quantile_below(bends, 0.95));
    const double by_bend = bend > 0 ? std::sqrt(8 * 0.5 * tolerance / bend) : usual;
    return usual > 0 ? std::clamp(by_bend, 0.5 * usual, 2 * usual) : by_bend;
}

std::vector<Stretch> resample(const Program& program, const ProgrammedSurface& laid, const LineEditor& editor, const ResampleRules& wanted) {
    ResampleRules rules = wanted;
    if (rules.spacing <= 0) rules.spacing = fitting_spacing(program, laid, rules.tolerance);
    if (rules.spacing <= 0) return {};
    return Resampler(program, laid, editor, rules).run();
}

}  // namespace clsurf
