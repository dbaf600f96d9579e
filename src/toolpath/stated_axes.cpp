#include "toolpath/stated_axes.h"

#include <cmath>

namespace clsurf {
namespace {

constexpr double least_turn = 1e-6;  // [rad]

/// Goes through the motions with the active axis.
class AxisReader {
public:
    explicit AxisReader(const Motions& motions) : motions_(motions) {}

    /// Whether the axis of a motion is known from its begin to its end.
    bool read(std::size_t motion) {
        const Vec3 axis_before = axis_;
        const Vec3 angles_before = angles_;
        const bool known_before = known_ || motion == 0;
        turn(motion);
        const bool turns = motion > 0 && (angle_between(axis_before, axis_) > least_turn ||
                                          (angles_ - angles_before).cwiseAbs().maxCoeff() > least_turn);
        return known_ && known_before && !turns;
    }
    [[nodiscard]] const Vec3& axis() const { return axis_; }

private:
    void turn(std::size_t motion) {
        if (!motions_.tool_axis.empty() && !std::isnan(motions_.tool_axis[motion].x)) {
            axis_ = motions_.tool_axis[motion].vec();
            known_ = true;
            return;
        }
        if (motions_.rotary.empty()) return;
        const Vec3 angles = motions_.rotary[motion].vec();
        if (angles.array().isNaN().any()) return;  // the previous vector determines them
        angles_ = angles;
        axis_ = Vec3::UnitZ();
        known_ = std::abs(angles.x()) <= least_turn && std::abs(angles.y()) <= least_turn;
    }

    const Motions& motions_;
    Vec3 axis_ = Vec3::UnitZ();
    Vec3 angles_ = Vec3::Zero();  ///< A, B, C [rad]
    bool known_ = true;
};

}  // namespace

StatedAxes stated_axes(const Motions& motions) {
    StatedAxes stated;
    if (motions.tool_axis.empty() && motions.rotary.empty()) return stated;
    stated.axis = Column<Xyz>(motions.kind.size());
    bool tilts = false;
    AxisReader reader(motions);
    for (std::size_t i = 0; i < motions.kind.size(); ++i) {
        const bool known = reader.read(i);
        const bool cuts = is_cut(motions.kind[i]);
        stated.axis[i] = Xyz(reader.axis());
        tilts = tilts || (cuts && angle_between(reader.axis(), Vec3::UnitZ()) > least_turn);
        if (cuts && !known && !stated.unknown) stated.unknown = static_cast<std::int64_t>(i);
    }
    if (!tilts) stated.axis = {};
    return stated;
}

}  // namespace clsurf
