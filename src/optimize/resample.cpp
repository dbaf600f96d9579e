#include "optimize/resample.h"

#include <algorithm>
#include <cmath>

#include "curve/akima.h"
#include "curve/polyline.h"
#include "optimize/stations.h"
#include "path/toolpath.h"

namespace clsurf {
namespace {

constexpr double knot_share = 0.6;        ///< of the spacing: closer points are no knots of the curve
constexpr double nearest_station = 0.35;  ///< of the spacing: a station nearer to a fixed point is left out
constexpr double rounding_reserve = 0.9;  ///< of the tolerance that is used: the rest is for the decimals
constexpr std::size_t shortest_stretch = 3;  ///< motions

/// One stretch of a pass between fixed points: its old points, and for each how far the way and the phase are.
struct Old {
    std::vector<Vec3> points;    ///< the first is where the stretch begins
    std::vector<double> way;     ///< [mm]
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
        const std::vector<double> stations = stations_of(pass.ends[begin], pass.ends[end]);
        Stretch stretch{motion(pass.ends[begin + 1]), motion(pass.ends[end]), {}};
        const std::vector<std::size_t> knots = knots_of(old);
        std::vector<Vec3> corners;
        for (const std::size_t k : knots) corners.push_back(old.points[k]);
        const std::vector<AkimaSpan> spans = akima_spans(corners);
        std::size_t span = 0, line = 0;
        for (const double way : stations) {
            while (span + 2 < knots.size() && old.way[knots[span + 1]] < way) ++span;
            const double from = old.way[knots[span]], to = old.way[knots[span + 1]];
            const Vec3 on_curve = spans[span].at(spans[span].chord * (way - from) / (to - from));
            while (line + 2 < old.way.size() && old.way[line + 1] < way) ++line;
            stretch.points.push_back({held(old, line, on_curve), 0});
        }
        stretch.points.push_back({old.points.back(), 0});
        if (!stays(old, stretch)) stretches_.push_back(std::move(stretch));
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

    /// A point no farther from the old lines about `line` than the tolerance leaves.
    [[nodiscard]] Vec3 held(const Old& old, std::size_t line, const Vec3& p) const {
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
            if ((stretch.points[k].position - old.points[k + 1]).norm() > 1e-3) return false;
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

double percentile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

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
    const double usual = percentile(std::move(lengths), 0.5), bend = percentile(std::move(bends), 0.95);
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
