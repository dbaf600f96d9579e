#include "compare/knot_path.h"

#include <algorithm>

#include "mapping/walk_window.h"

namespace clsurf {
namespace {

// Lengths in mm.
constexpr float spacing = 0.005F;    ///< least distance between knots, above the noise of resting axes
constexpr float same_place = 1e-6F;  ///< share of a chord
constexpr float same_spot = 1e-6F;

}  // namespace

KnotPath::KnotPath(const Positions& b, const Eigen::Vector3f& shift) : b_(b), shift_(shift) {
    Eigen::Vector3f last = Eigen::Vector3f::Zero();
    PointIndex last_known = -1;
    for (PointIndex i = 0; i < b.size(); ++i) {
        const Eigen::Vector3f p = b[i];
        if (!p.allFinite()) continue;
        last_known = i;
        if (!knots_.empty() && (p - last).squaredNorm() < spacing * spacing) continue;
        knots_.push_back(i);
        last = p;
    }
    // The last point always belongs to the path.
    if (last_known >= 0 && knots_.back() != last_known) knots_.push_back(last_known);
}

std::int64_t KnotPath::knot_at(PointIndex point) const {
    const PointIndex* after = std::upper_bound(knots_.begin(), knots_.end(), point);
    return std::max<std::int64_t>(0, after - knots_.begin() - 1);
}

PathProjection KnotPath::projection(std::int64_t knot, const Eigen::Vector3f& p, float from) const {
    const Eigen::Vector3f a = at(point(knot));
    const Eigen::Vector3f chord = at(point(knot + 1)) - a;
    const float squared = chord.squaredNorm();
    const float fraction = squared > 0 ? std::clamp((p - a).dot(chord) / squared, from, 1.0F) : 1.0F;
    return {knot, fraction, (a + fraction * chord - p).norm()};
}

PathProjection KnotPath::advance(const PathProjection& from, const Eigen::Vector3f& p, float chord) const {
    PathProjection best = from;
    WalkWindow<float> window(chord);
    float arc_length = 0;  // from the projection to the start of the present chord; negative on the first one
    for (std::int64_t k = from.knot; k + 1 < size(); ++k) {
        const float length = (at(point(k + 1)) - at(point(k))).norm();
        if (k == from.knot) arc_length = -from.fraction * length;
        const PathProjection here = projection(k, p, k == from.knot ? from.fraction : 0.0F);
        if (window.is_better(here.distance, arc_length + here.fraction * length)) best = here;
        arc_length += length;
        if (window.ends_before(arc_length)) break;
    }
    // The end of a chord is replaced by the start of the next, where pauses are handled.
    if (best.fraction == 1.0F && best.knot + 2 < size()) best = {best.knot + 1, 0.0F, best.distance};
    return best;
}

PathLocation KnotPath::location(const PathProjection& projected, const Eigen::Vector3f& p, PointIndex expected) const {
    // Synchronous runs stay synchronous: in a corner, the chord does not give the order of the points on it.
    const PointIndex before = point(std::max<std::int64_t>(0, projected.knot - 1));
    const PointIndex after = point(std::min(size() - 1, projected.knot + 2));
    if (expected >= before && expected <= after && (at(expected) - p).squaredNorm() < same_spot * same_spot)
        return {expected, 0};
    const PointIndex first = point(projected.knot);
    const PointIndex last = point(projected.knot + 1);
    if (last == first + 1)
        return projected.fraction == 1.0F ? PathLocation{last, 0} : PathLocation{first, projected.fraction};
    // Points between two knots are on their chord, in order except for the noise of a resting axis.
    const Eigen::Vector3f a = at(first);
    const Eigen::Vector3f chord = at(last) - a;
    const float squared = chord.squaredNorm();
    if (!(squared > 0)) return {std::clamp(expected, first, last), 0};
    const auto along = [&](PointIndex i) { return (at(i) - a).dot(chord) / squared; };
    const auto first_where = [&](auto&& holds) {
        PointIndex low = first;
        PointIndex high = last + 1;
        while (low < high) {
            const PointIndex middle = low + (high - low) / 2;
            if (holds(along(middle)))
                high = middle;
            else
                low = middle + 1;
        }
        return low;
    };
    const PointIndex from = first_where([&](float s) { return s >= projected.fraction - same_place; });
    const PointIndex behind = first_where([&](float s) { return s > projected.fraction + same_place; });
    if (behind > from) return {std::clamp(expected, from, behind - 1), 0};
    if (from == first || from > last) return {std::min(from, last), 0};
    const float low = along(from - 1);
    const float high = along(from);
    const float share = high > low ? std::clamp((projected.fraction - low) / (high - low), 0.0F, 1.0F) : 0.0F;
    return share == 1.0F ? PathLocation{from, 0} : PathLocation{from - 1, share};
}

}  // namespace clsurf
