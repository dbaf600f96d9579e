#pragma once
// KnotPath: a run without the points at which the tool (almost) rests. Another run is aligned with the chain of chords between
// its knots. Noise of a resting axis adds no arc length.

#include "surface/path_location.h"

namespace clsurf {

/// The projection of a point on a path.
struct PathProjection {
    std::int64_t knot = 0;  ///< on the chord from this knot to the next
    float fraction = 0;     ///< of the chord
    float distance = 0;     ///< [mm] from the point to its projection
};

class KnotPath {
public:
    /// `b` must outlive it. `shift` [mm]: added to its positions. O(points).
    KnotPath(const Positions& b, const Eigen::Vector3f& shift);

    [[nodiscard]] std::int64_t size() const { return static_cast<std::int64_t>(knots_.size()); }
    [[nodiscard]] PointIndex point(std::int64_t knot) const { return knots_[static_cast<std::size_t>(knot)]; }
    /// The last knot at or before a point.
    [[nodiscard]] std::int64_t knot_at(PointIndex point) const;
    /// The projection of `p` on one chord at or after `from`. Domain: knot + 1 < size().
    [[nodiscard]] PathProjection projection(std::int64_t knot, const Eigen::Vector3f& p, float from) const;
    /// The projection of `p` at or after `from`, for a tool that moved by `chord` [mm].
    [[nodiscard]] PathProjection advance(const PathProjection& from, const Eigen::Vector3f& p, float chord) const;
    /// The location between the points of B for `p`, whose projection is `projected`. Among points at one place (B rests), it
    /// is the one nearest to `expected`, so that pauses of both runs are traversed at the same rate.
    [[nodiscard]] PathLocation location(const PathProjection& projected, const Eigen::Vector3f& p,
                                        PointIndex expected) const;

private:
    [[nodiscard]] Eigen::Vector3f at(PointIndex point) const { return b_[point] + shift_; }

    const Positions& b_;
    Eigen::Vector3f shift_;
    Column<PointIndex> knots_;
};

}  // namespace clsurf
