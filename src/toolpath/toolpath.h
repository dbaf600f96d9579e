#pragma once
// Toolpath: the programmed motions as geometry: the nearest point of a motion, and its length. Lines, arcs, helices
// and curves; dwells are points.

#include <memory>

#include "core/geometry.h"
#include "program/motion.h"

namespace clsurf {

/// The nearest point of a motion to a position.
struct Projection {
    double distance = 0;  ///< [mm]
    double fraction = 0;  ///< of the motion's arc length, 0 … 1
};

class Toolpath {
public:
    /// `motions` must outlive it. `rest`: the coordinates before the program sets them (the controller's own start
    /// position) [mm].
    Toolpath(const Motions& motions, const Vec3& rest) : motions_(&motions), rest_(rest) {}

    [[nodiscard]] std::int64_t size() const { return motions_->size(); }
    [[nodiscard]] const Motions& motions() const { return *motions_; }
    [[nodiscard]] Vec3 begin(std::int64_t motion) const { return known(motions_->begin_of(motion)); }
    [[nodiscard]] Vec3 end(std::int64_t motion) const { return known(motions_->end[static_cast<std::size_t>(motion)]); }
    /// The curve of a motion with all its coordinates known; nullptr if it has none.
    [[nodiscard]] std::shared_ptr<const BezierCurve> curve(std::int64_t motion) const;
    /// The point at a fraction of a motion's arc length.
    [[nodiscard]] Vec3 at(std::int64_t motion, double fraction) const;
    /// Unit vector of travel at a fraction of a motion's arc length; 0: a dwell, or a motion without a length.
    [[nodiscard]] Vec3 direction(std::int64_t motion, double fraction) const;
    /// The greatest curvature of a motion [1/mm]: exact for an arc or helix, from 33 points of a spline; 0 for a
    /// line.
    [[nodiscard]] double curvature(std::int64_t motion) const;
    /// Arc length along a motion [mm].
    [[nodiscard]] double length(std::int64_t motion) const;
    /// The nearest point of a motion at or after `from` (fraction of its arc length) to `p`.
    [[nodiscard]] Projection projection(std::int64_t motion, const Vec3& p, double from = 0.0) const;

private:
    [[nodiscard]] Vec3 known(const Xyz& v) const {
        return {v.x == v.x ? v.x : rest_.x(), v.y == v.y ? v.y : rest_.y(), v.z == v.z ? v.z : rest_.z()};
    }

    const Motions* motions_;
    Vec3 rest_;
};

}  // namespace clsurf
