#pragma once
// CornerArcs: replaces every corner that has a transition arc by this arc. The first half of an arc belongs to
// the block before the corner, the second half to the block after it.

#include <deque>

#include "simulation/path/arc_steps.h"
#include "simulation/path/block_stream.h"
#include "simulation/path/transition_arc.h"

namespace clsurf {

class CornerArcs final : public ElementSource {
public:
    /// Both references must outlive the object.
    CornerArcs(ElementSource& source, const Machine& machine) : source_(&source), machine_(&machine), steps_(machine) {}

    [[nodiscard]] bool next(PathElement& element) override;

private:
    /// The effect of the step at the end of an arc on the adjacent block.
    struct Side {
        double speed = 0;  ///< allowed speed [mm/s]; 0: no step
        double reach = 0;  ///< affected length of the block [mm]
    };

    void add_corner(const PathElement& after);
    [[nodiscard]] Side side_of(const TransitionArc& arc, const PathElement& whole, const PathElement& after);
    void add_block(double end, const Side& at_end);
    void add_piece(double from, double to, const Side* beside);

    /// The curvature at a place of an arc, or on a line.
    struct Bend {
        double at = 0;  ///< arc length [mm]
        Vec3 value = Vec3::Zero();
    };

    ElementSource* source_;
    const Machine* machine_;
    ArcSteps steps_;
    bool holds_ = false;
    PathElement held_;         ///< the last block
    double used_ = 0;          ///< length that the arc at its start replaces [mm]
    Side begun_;               ///< effect of that arc
    double passed_ = 0;        ///< arc length at which the rest of the last block begins [mm]
    std::deque<Bend> recent_;  ///< bends close enough to add to a step here
    std::deque<PathElement> ready_;
};

}  // namespace clsurf
