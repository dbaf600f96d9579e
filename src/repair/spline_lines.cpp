#include "repair/spline_lines.h"

#include <cmath>

#include <fmt/format.h>

#include "core/decimal_text.h"
#include "program/text/nc_text.h"

namespace clsurf {
namespace {

constexpr int degree = 3;
constexpr int knot_decimals = 3;   ///< section_spline() has knots on these steps
constexpr int finer_decimals = 3;  ///< additional decimals of directions and coefficients, for smooth joints

std::string point(const Vec3& p, const SplineWords& w) {
    std::string text;
    for (std::size_t a = 0; a < 3; ++a)
        text += fmt::format("{}{}{}", a > 0 ? " " : "", w.words[a], fixed_text(p[static_cast<int>(a)], w.decimals));
    return text;
}

/// With separate knots: each point has one, and the last degree + 1 knots follow (Fanuc).
std::vector<std::string> knotted_lines(const Nurbs& spline, const SplineWords& w) {
    std::vector<std::string> points, knots;
    for (const Vec3& p : spline.points) points.push_back(point(p, w));
    for (const double knot : spline.knots) knots.push_back(fixed_text(knot, knot_decimals));
    return fanuc_nurbs_lines(points, knots);
}

/// Control points after the first; the i-th has the length of the i-th span (Siemens).
std::vector<std::string> basis_lines(const Nurbs& spline, const SplineWords& w) {
    std::vector<std::string> lines;
    const std::size_t spans = spans_in(spline);
    for (std::size_t k = 1; k < spline.points.size(); ++k) {
        std::string line = (k == 1 ? "BSPLINE SD=3 " : "") + point(spline.points[k], w);
        if (k <= spans)
            line += " PL=" + fixed_text(spline.knots[degree + k] - spline.knots[degree + k - 1], knot_decimals);
        lines.push_back(std::move(line));
    }
    return lines;
}

/// A point as it is read back.
Vec3 written(const Vec3& p, int decimals) {
    const double steps = std::pow(10.0, decimals);
    return (p * steps).array().round() / steps;
}

/// One block per span. G5: from the begin, and from the end, to the inner points. SPL: a polynomial of t from 1 to 0.
std::vector<std::string> span_lines(const Nurbs& spline, SplineForm form, const SplineWords& w) {
    std::vector<std::string> lines;
    const int finer = w.decimals + finer_decimals;
    for (const NurbsSpan& span : spans_of(spline)) {
        const Vec3 begin = written(span.curve.point(0), w.decimals), end = written(span.curve.point(3), w.decimals);
        const Vec3 &first = span.curve.point(1), &second = span.curve.point(2);
        if (form == SplineForm::cubic_plane) {
            const Vec3 out = first - begin, in = second - end;
            lines.push_back(fmt::format("G5 {}{} {}{} I{} J{} P{} Q{}", w.words[0], fixed_text(end.x(), w.decimals),
                                        w.words[1], fixed_text(end.y(), w.decimals), fixed_text(out.x(), finer),
                                        fixed_text(out.y(), finer), fixed_text(in.x(), finer),
                                        fixed_text(in.y(), finer)));
            continue;
        }
        const std::array<Vec3, 3> factors{3 * (second - end), 3 * (first - 2 * second + end),
                                          begin - 3 * first + 3 * second - end};
        std::string line = "SPL";
        for (std::size_t a = 0; a < 3; ++a)
            line += fmt::format(" {}{}", "XYZ"[a], signed_text(end[static_cast<int>(a)], w.decimals));
        for (std::size_t a = 0; a < 3; ++a) {
            for (std::size_t power = 3; power > 0; --power)
                line += fmt::format(" K{}{}{}", power, "XYZ"[a],
                                    signed_text(factors[power - 1][static_cast<int>(a)], finer));
        }
        lines.push_back(std::move(line));
    }
    return lines;
}

}  // namespace

std::size_t blocks_of_spline(const Nurbs& spline, SplineForm form) {
    switch (form) {
        case SplineForm::none: return 0;
        case SplineForm::cubic_plane: return spans_in(spline) + 1;
        case SplineForm::knotted: return spline.points.size() + degree + 2;
        case SplineForm::basis: return spline.points.size();
        case SplineForm::polynomial: return spans_in(spline);
    }
    return 0;
}

std::size_t blocks_before_spans(SplineForm form) {
    switch (form) {
        case SplineForm::knotted: return degree;
        case SplineForm::basis: return degree - 1;
        default: return 0;
    }
}

std::size_t blocks_behind_spans(SplineForm form) {
    switch (form) {
        case SplineForm::knotted: return degree + 2;
        case SplineForm::basis:
        case SplineForm::cubic_plane: return 1;
        default: return 0;
    }
}

std::vector<std::string> spline_lines(const Nurbs& spline, SplineForm form, const SplineWords& words) {
    std::vector<std::string> lines = form == SplineForm::knotted ? knotted_lines(spline, words)
                                     : form == SplineForm::basis ? basis_lines(spline, words)
                                                                 : span_lines(spline, form, words);
    if (!words.straight.empty()) lines.push_back(words.straight);
    return lines;
}

}  // namespace clsurf
