#include "toolpath/toolpath_summary.h"

#include <cmath>

namespace clsurf {
namespace {

/// An arc's box: points every few degrees and its ends, which is within 10^-4 of the radius.
void extend_by_arc(Box3& box, const Toolpath& path, std::int64_t motion) {
    constexpr int pieces = 360;
    for (int k = 0; k <= pieces; ++k) box.extend(path.at(motion, static_cast<double>(k) / pieces));
}

/// The box of a span of a spline, which turns less than an arc.
void extend_by_curve(Box3& box, const BezierCurve& curve) {
    constexpr int pieces = 64;
    for (int k = 0; k <= pieces; ++k) {
        const Vec3 p = curve.at(static_cast<double>(k) / pieces);
        if (p.allFinite()) box.extend(p);
    }
}

}  // namespace

ToolpathSummary summarise(const Motions& motions) {
    ToolpathSummary s;
    const Toolpath path(motions, Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
    for (std::int64_t m = 0; m < path.size(); ++m) {
        const MotionKind kind = motions.kind[static_cast<std::size_t>(m)];
        if (kind == MotionKind::dwell) ++s.dwells;
        if (kind == MotionKind::rapid) ++s.rapids;
        if (kind == MotionKind::dwell || kind == MotionKind::rapid) continue;
        (is_arc(kind) ? s.arcs : kind == MotionKind::spline ? s.splines : s.feeds) += 1;
        const double length = path.length(m);
        if (std::isfinite(length)) s.cutting_length += length;
        if (is_arc(kind)) {
            extend_by_arc(s.bounds, path, m);
            continue;
        }
        if (const auto curve = path.curve(m)) {
            extend_by_curve(s.bounds, *curve);
            continue;
        }
        for (const Vec3& p : {path.begin(m), path.end(m)}) {
            if (p.allFinite()) s.bounds.extend(p);
        }
    }
    return s;
}

}  // namespace clsurf
