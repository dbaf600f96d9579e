#pragma once
// ProgrammedMarks: how far the programmed passes of defects lie from where the adjacent passes say. The form of a surface
// follows the program (form.h), and a pass that is programmed too high or too low would be form, not a mark. Without
// these offsets, the same surface gives the same numbers whether the program or the machine made the mark.

#include <span>
#include <vector>

#include "predictor/defect.h"
#include "predictor/signals.h"
#include "surface/cl_surface.h"

namespace clsurf {

class ProgrammedMarks {
public:
    ProgrammedMarks() = default;

    /// Of those defects of a report whose depth is that of the programmed positions. At each point of their passes the
    /// height is interpolated across the feed from the two nearest passes on either side that no such defect is on; a
    /// point without a pass on both sides has no offset. O(points of these defects).
    ProgrammedMarks(const ClSurface& surface, const Signals& signals, const QualityReport& report);

    /// How far a point lies above the adjacent passes [mm], as a vector along the normal; zero where no mark is.
    [[nodiscard]] Vec3 at(PointIndex point) const;
    /// Takes the offsets off one axis of positions [mm] from a point on.
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
