#include "optimize/deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "path/toolpath.h"

namespace clsurf {
namespace {

constexpr double window = 1.0;       ///< [mm] of way to both sides of where the walk has come to
constexpr double same_place = 1e-9;  ///< [mm]
constexpr double most_pieces = 1e6;  ///< of one motion

/// Walks along a path beside points that come in its order.
class Walk {
public:
    explicit Walk(const Toolpath& path) : path_(path) {}

    /// Distance from `p` to the path near the foot of the point before.
    [[nodiscard]] double distance(const Vec3& p) {
        std::int64_t low = at_;
        double before = way_before_;
        while (low > 0 && before > way_ - window) before -= path_.length(--low);
        double nearest = std::numeric_limits<double>::infinity();
        double way = way_;
        for (std::int64_t m = low; m < path_.size() && (before <= way + window || !std::isfinite(nearest)); ++m) {
            const double length = path_.length(m);
            if (length <= 0 && std::isfinite(nearest)) continue;
            Foot foot = path_.foot(m, p);
            if (length > 0) {
                // Of a long motion only what lies in the window counts.
                const double inside = std::clamp(foot.fraction, std::clamp((way - window - before) / length, 0.0, 1.0),
                                                 std::clamp((way + window - before) / length, 0.0, 1.0));
                if (inside != foot.fraction) foot = {(path_.at(m, inside) - p).norm(), inside};
            }
            // The later of two that are as near: a path that goes back on itself is not to be walked back.
            if (foot.distance <= nearest + same_place) {
                nearest = std::min(nearest, foot.distance);
                at_ = m;
                way_before_ = before;
                way_ = before + (length > 0 ? foot.fraction * length : 0);
            }
            before += length;
        }
        return nearest;
    }

private:
    const Toolpath& path_;
    std::int64_t at_ = 0;
    double way_before_ = 0, way_ = 0;
};

/// Calls take(motion, point, distance) for points of `from` against `to`.
template <typename Take>
void compare(const Toolpath& from, const Toolpath& to, double step, const Take& take) {
    Walk walk(to);
    for (std::int64_t i = 0; i < from.size(); ++i) {
        // What lies between rapids has to be there; rapids themselves are compared by their ends.
        const bool rapid = from.motions().kind[static_cast<std::size_t>(i)] == MotionKind::rapid;
        const double pieces = rapid ? std::ceil(from.length(i) / (0.5 * window)) : std::ceil(from.length(i) / step);
        const auto n = static_cast<int>(std::clamp(pieces, 1.0, most_pieces));
        for (int k = 1; k <= n; ++k) {
            const Vec3 p = from.at(i, static_cast<double>(k) / n);
            take(i, p, walk.distance(p));
        }
    }
}

bool is_plain(const Motions& motions, std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    const bool turns = !motions.rotary.empty() && i > 0 && !(motions.rotary[k] == motions.rotary[k - 1]);
    return motions.kind[k] == MotionKind::feed && !turns;
}

bool same(const Motions& a, std::int64_t i, const Motions& b, std::int64_t j) {
    const auto k = static_cast<std::size_t>(i), l = static_cast<std::size_t>(j);
    const auto equal = [](const Xyz& p, const Xyz& q) {
        const auto one = [](double x, double y) { return std::abs(x - y) <= same_place || (x != x && y != y); };
        return one(p.x, q.x) && one(p.y, q.y) && one(p.z, q.z);
    };
    if (a.kind[k] != b.kind[l] || !equal(a.end[k], b.end[l])) return false;
    const bool feeds = a.feed[k] == b.feed[l] || (a.feed[k] != a.feed[k] && b.feed[l] != b.feed[l]);
    if (!feeds) return false;
    if (!a.rotary.empty() && !equal(a.rotary[k], b.rotary[l])) return false;
    const Arc *arc = a.arc_of(i), *other = b.arc_of(j);
    if (arc == nullptr || other == nullptr) return arc == other;
    return arc->centre == other->centre && arc->turns == other->turns && arc->axis == other->axis;
}

LineNumber first_disorder(const Motions& a, const Motions& b) {
    if (a.rotary.empty() != b.rotary.empty()) return 1;
    std::int64_t i = 0, j = 0;
    while (true) {
        while (i < a.size() && is_plain(a, i)) ++i;
        while (j < b.size() && is_plain(b, j)) ++j;
        if (i == a.size() && j == b.size()) return 0;
        if (i == a.size() || j == b.size() || !same(a, i, b, j))
            return b.size() > 0 ? b.line[static_cast<std::size_t>(std::min(j, b.size() - 1))] : 1;
        ++i, ++j;
    }
}

}  // namespace

Deviation measure_deviation(const Program& before, const Program& after, double step) {
    const Toolpath old(before.motions, Vec3::Zero()), now(after.motions, Vec3::Zero());
    Deviation deviation;
    deviation.disordered = first_disorder(before.motions, after.motions);
    const auto take = [&](LineNumber line, const Vec3& p, double distance) {
        if (distance > deviation.greatest) deviation = {distance, line, p, deviation.disordered};
    };
    compare(now, old, step, [&](std::int64_t i, const Vec3& p, double distance) {
        take(now.motions().line[static_cast<std::size_t>(i)], p, distance);
    });
    compare(old, now, step, [&](std::int64_t, const Vec3& p, double distance) { take(0, p, distance); });
    return deviation;
}

}  // namespace clsurf
