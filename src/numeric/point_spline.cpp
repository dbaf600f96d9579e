#include "numeric/point_spline.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace clsurf {
namespace {

using EndKind = PointSplineEnd::Kind;

struct ChordSlopes {
    std::vector<double> length;
    std::vector<Vec3> slope;

    explicit ChordSlopes(std::span<const Vec3> points) {
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const Vec3 chord = points[i + 1] - points[i];
            length.push_back(chord.norm());
            slope.push_back(chord / length.back());
        }
    }
};

/// low s_{i−1} + middle s_i + high s_{i+1} = right for the slopes s.
struct Row {
    double low, middle, high;
    Vec3 right;
};

/// The second derivative is equal at both ends of the span.
Row even_row(const Vec3& slope) { return {1, 1, 1, 2 * slope}; }

/// The equation of an end. `outer`: the span there; `inner`: the next one, the same if there is only one.
Row end_row(const PointSplineEnd& of, const ChordSlopes& chords, std::size_t outer, std::size_t inner) {
    const Vec3& slope = chords.slope[outer];
    switch (of.kind) {
        case EndKind::tangent: return {0, 1, 0, of.direction};
        case EndKind::natural: return {1, 2, 1, 3 * slope};
        case EndKind::free: break;
    }
    if (outer == inner) return even_row(slope);
    // The third derivative is equal in both spans.
    const double h = chords.length[outer], beside = chords.length[inner], both = h + beside;
    return {both, beside, both, ((h + 2 * both) * beside * slope + h * h * chords.slope[inner]) / both};
}

std::vector<BezierCurve> spans_with(std::span<const Vec3> points, const ChordSlopes& chords,
                                    const std::vector<Vec3>& slopes) {
    std::vector<BezierCurve> spans;
    spans.reserve(chords.length.size());
    for (std::size_t i = 0; i < chords.length.size(); ++i) {
        const double third = chords.length[i] / 3;
        spans.emplace_back(std::array<Vec3, 4>{points[i], points[i] + third * slopes[i],
                                               points[i + 1] - third * slopes[i + 1], points[i + 1]});
    }
    return spans;
}

}  // namespace

std::vector<BezierCurve> cubic_spline(std::span<const Vec3> points, const PointSplineEnd& begin,
                                      const PointSplineEnd& end) {
    const ChordSlopes chords(points);
    const std::size_t last = points.size() - 1;
    const bool free = begin.kind == EndKind::free && end.kind == EndKind::free;
    std::vector<Row> rows(last + 1);
    rows[0] = end_row(begin, chords, 0, std::min<std::size_t>(1, last - 1));
    rows[last] = end_row(end, chords, last - 1, last > 1 ? last - 2 : 0);
    // With one span, two free ends give the same equation, and likewise with two: the result is a line or a parabola.
    if (free && last == 1) rows[0] = {0, 1, 0, chords.slope[0]};
    if (free && last == 2) rows[0] = even_row(chords.slope[0]);
    for (std::size_t i = 1; i < last; ++i) {
        const double before = chords.length[i - 1], behind = chords.length[i];
        rows[i] = {behind, 2 * (before + behind), before,
                   3 * (behind * chords.slope[i - 1] + before * chords.slope[i])};
    }
    for (std::size_t i = 1; i <= last; ++i) {
        const double factor = rows[i].low / rows[i - 1].middle;
        rows[i].middle -= factor * rows[i - 1].high;
        rows[i].right -= factor * rows[i - 1].right;
    }
    std::vector<Vec3> slopes(last + 1);
    slopes[last] = rows[last].right / rows[last].middle;
    for (std::size_t i = last; i-- > 0;) slopes[i] = (rows[i].right - rows[i].high * slopes[i + 1]) / rows[i].middle;
    return spans_with(points, chords, slopes);
}

std::vector<BezierCurve> akima_spline(std::span<const Vec3> points, const PointSplineEnd& begin,
                                      const PointSplineEnd& end) {
    const ChordSlopes chords(points);
    const std::size_t last = points.size() - 1;
    std::vector<Vec3> slopes(last + 1, chords.slope[0]);
    if (last > 1) {
        // Two more chords at each end, extrapolated linearly.
        std::vector<Vec3> m(2);
        m.insert(m.end(), chords.slope.begin(), chords.slope.end());
        m[1] = 2 * m[2] - m[3];
        m[0] = 2 * m[1] - m[2];
        for (int k = 0; k < 2; ++k) m.push_back(2 * m[m.size() - 1] - m[m.size() - 2]);
        for (std::size_t i = 0; i <= last; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                const double behind = std::abs(m[i + 3][axis] - m[i + 2][axis]);
                const double before = std::abs(m[i + 1][axis] - m[i][axis]);
                constexpr double none = 1e-12;
                slopes[i][axis] = behind + before > none
                                      ? (behind * m[i + 1][axis] + before * m[i + 2][axis]) / (behind + before)
                                      : 0.5 * (m[i + 1][axis] + m[i + 2][axis]);
            }
        }
    }
    if (begin.kind == EndKind::tangent) slopes[0] = begin.direction;
    if (end.kind == EndKind::tangent) slopes[last] = end.direction;
    if (begin.kind == EndKind::natural) slopes[0] = 0.5 * (3 * chords.slope.front() - slopes[1]);
    if (end.kind == EndKind::natural) slopes[last] = 0.5 * (3 * chords.slope.back() - slopes[last - 1]);
    return spans_with(points, chords, slopes);
}

}  // namespace clsurf
