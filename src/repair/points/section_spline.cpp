#include "repair/points/section_spline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "numeric/banded_ldlt.h"

namespace clsurf {
namespace {

constexpr int degree = 3;
constexpr std::size_t width = 3;             ///< diagonals on each side of the normal matrix; as many as the degree
constexpr double samples_a_spacing = 4;      ///< at least; a span is no shorter than a spacing
constexpr double spacings_a_span = 64;       ///< spacings per span before spans are halved
constexpr std::size_t samples_at_least = 8;  ///< of a section
constexpr double most_samples = 1e6;
/// Times the chord error: largest distance of a spline from the smooth curve. With one chord error, it would copy the scatter
/// that the curve keeps, in spans nearly as short as lines (docs/optimize.md#splines).
constexpr double curve_share = 3;

/// The four B-splines of degree 3 that are not zero in the span between knots k and k + 1, at u (the NURBS Book, A2.2).
std::array<double, degree + 1> basis_at(const std::vector<double>& knots, std::size_t k, double u) {
    std::array<double, degree + 1> basis{1, 0, 0, 0};
    for (std::size_t j = 1; j <= degree; ++j) {
        double saved = 0;
        for (std::size_t r = 0; r < j; ++r) {
            const double right = knots[k + r + 1] - u, left = u - knots[k + 1 + r - j];
            const double share = basis[r] / (right + left);
            basis[r] = saved + right * share;
            saved = left * share;
        }
        basis[j] = saved;
    }
    return basis;
}

class SplineFit {
public:
    SplineFit(const OldSegment& old, const SmoothCurve& curve, const LineRules& rules)
        : old_(old), rules_(rules), end_(std::round(old.length() / spline_knot_step) * spline_knot_step) {
        const double wanted = std::ceil(samples_a_spacing * old.length() / rules.spacing);
        const auto samples =
            static_cast<std::size_t>(std::clamp(wanted, static_cast<double>(samples_at_least), most_samples));
        for (std::size_t k = 0; k <= samples; ++k) {
            const double share = static_cast<double>(k) / static_cast<double>(samples);
            at_.push_back(share * end_);
            places_.push_back(curve.at(share * old.length()));
        }
        const double spans = std::max(1.0, std::round(end_ / (spacings_a_span * rules.spacing)));
        for (double k = 0; k <= spans; ++k) ends_.push_back(on_step(end_ * k / spans));
    }

    std::optional<Nurbs> run() {
        while (fit()) {
            const std::vector<std::uint8_t> bad = bad_spans();
            if (std::find(bad.begin(), bad.end(), 1) == bad.end())
                return Nurbs{degree, points_, std::vector<double>(points_.size(), 1.0), knots_};
            if (!halve(bad)) return std::nullopt;
        }
        return std::nullopt;
    }

private:
    [[nodiscard]] static double on_step(double u) { return std::round(u / spline_knot_step) * spline_knot_step; }

    /// Computes control points for the present spans. Returns false if the samples do not determine them.
    bool fit() {
        knots_.assign(degree, 0.0);
        knots_.insert(knots_.end(), ends_.begin(), ends_.end());
        knots_.insert(knots_.end(), degree, ends_.back());
        const std::size_t count = ends_.size() - 1 + degree, inner = count - 2;
        std::array<std::vector<double>, width + 1> matrix;
        for (std::vector<double>& diagonal : matrix) diagonal.assign(inner, 0.0);
        std::vector<Vec3> right(inner, Vec3::Zero());
        std::size_t span = 0;
        for (std::size_t i = 0; i < at_.size(); ++i) {
            while (span + 2 < ends_.size() && at_[i] >= ends_[span + 1]) ++span;
            const std::array<double, degree + 1> basis = basis_at(knots_, span + degree, at_[i]);
            Vec3 rest = places_[i];
            if (span == 0) rest -= basis[0] * old_.points.front();
            if (span + 2 == ends_.size()) rest -= basis[degree] * old_.points.back();
            for (std::size_t a = 0; a <= degree; ++a) {
                const std::size_t row = span + a;  // among all control points; both ends are known
                if (row == 0 || row + 1 == count) continue;
                right[row - 1] += basis[a] * rest;
                for (std::size_t b = 0; b <= a; ++b) {
                    if (span + b > 0) matrix[a - b][span + b - 1] += basis[a] * basis[b];
                }
            }
        }
        const BandedDiagonals<width> factors{matrix[0], matrix[1], matrix[2], matrix[3]};
        if (!factorise_banded<width>(factors)) return false;
        solve_banded<width, Vec3>(factors, right);
        points_.assign(1, old_.points.front());
        points_.insert(points_.end(), right.begin(), right.end());
        points_.push_back(old_.points.back());
        return true;
    }

    [[nodiscard]] Vec3 value(std::size_t span, double u) const {
        const std::array<double, degree + 1> basis = basis_at(knots_, span + degree, u);
        Vec3 sum = Vec3::Zero();
        for (std::size_t a = 0; a <= degree; ++a) sum += basis[a] * points_[span + a];
        return sum;
    }

    /// The distance of `p` from the spline near u, normal to its direction there.
    [[nodiscard]] double across(std::size_t span, double u, const Vec3& p) const {
        const double step = 0.01 * (ends_[span + 1] - ends_[span]);
        const Vec3 along =
                       (value(span, std::min(u + step, ends_[span + 1])) - value(span, std::max(u - step, ends_[span])))
                           .normalized(),
                   off = p - value(span, u);
        return (off - off.dot(along) * along).norm();
    }

    /// The spans that are too far from the curve, the old lines or the old points.
    [[nodiscard]] std::vector<std::uint8_t> bad_spans() const {
        std::vector<std::uint8_t> bad(ends_.size() - 1, 0);
        const double to_old = old_.length() / end_;
        std::size_t span = 0;
        for (std::size_t i = 0; i < at_.size(); ++i) {
            while (span + 1 < bad.size() && at_[i] >= ends_[span + 1]) ++span;
            if (bad[span] != 0) continue;
            const Vec3 p = value(span, at_[i]);
            if ((p - places_[i]).norm() > curve_share * rules_.chord_error ||
                (p - old_.projection(p, at_[i] * to_old).position).norm() > rules_.most)
                bad[span] = 1;
        }
        span = 0;
        for (std::size_t k = 1; k + 1 < old_.points.size(); ++k) {
            const double u = old_.arc_length[k] / to_old;
            while (span + 1 < bad.size() && u >= ends_[span + 1]) ++span;
            if (bad[span] == 0 && across(span, u, old_.points[k]) > rules_.most) bad[span] = 1;
        }
        return bad;
    }

    /// Returns false if spans would be shorter than the spacing.
    bool halve(const std::vector<std::uint8_t>& bad) {
        std::vector<double> ends{0};
        for (std::size_t k = 0; k < bad.size(); ++k) {
            if (bad[k] != 0) {
                if (ends_[k + 1] - ends_[k] < 2 * rules_.spacing + spline_knot_step) return false;
                ends.push_back(on_step(0.5 * (ends_[k] + ends_[k + 1])));
            }
            ends.push_back(ends_[k + 1]);
        }
        ends_ = std::move(ends);
        return true;
    }

    const OldSegment& old_;
    const LineRules& rules_;
    double end_;  ///< the last knot: the length of the old lines in steps
    std::vector<double> at_;
    std::vector<Vec3> places_;  ///< of the curve, one for each of `at_`
    std::vector<double> ends_;  ///< of spans; the first entry is the beginning
    std::vector<double> knots_;
    std::vector<Vec3> points_;
};

}  // namespace

std::optional<Nurbs> section_spline(const OldSegment& old, const SmoothCurve& curve, const LineRules& rules) {
    if (old.length() < 2 * rules.spacing || old.length() < 10 * spline_knot_step) return std::nullopt;
    return SplineFit(old, curve, rules).run();
}

}  // namespace clsurf
