#pragma once
// ProgrammedMarks: the offsets of the programmed passes of defects from the height that the adjacent passes give. The form of a
// surface follows the program (form.h), so a pass that is programmed too high or too low would be form instead of a mark.
// Without these offsets, a surface gives the same numbers whether the program or the machine caused the mark.

#include <span>
#include <vector>

#include "predictor/defect.h"
#include "predictor/signals.h"
#include "surface/cl_surface.h"

namespace clsurf {

class ProgrammedMarks {
public:
    ProgrammedMarks() = default;

    /// For the defects of a report whose depth is in the programmed positions. At each point of their passes the height is
    /// interpolated across the feed from the two nearest passes on either side without such a defect. A point without passes on
    /// both sides has no offset. O(points of these defects).
    ProgrammedMarks(const ClSurface& surface, const Signals& signals, const QualityReport& report);

    /// The offset of a point from the adjacent passes [mm], as a vector along the normal; zero outside of marks.
    [[nodiscard]] Vec3 at(PointIndex point) const;
    /// Subtracts the offsets from one axis of positions [mm], which begin at point `first`.
    void take_off(PointIndex first, int axis, std::span<double> positions) const;

private:
    /// Consecutive points with an offset.
    struct Run {
        PointIndex first = 0;
        std::vector<Eigen::Vector3f> offsets;
    };
    [[nodiscard]] std::vector<Run>::const_iterator run_from(PointIndex point) const;

    std::vector<Run> runs_;  ///< in the order of their points
};

}  // namespace clsurf
