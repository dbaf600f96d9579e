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
    /// Both must outlive it.
    CornerArcs(ElementSource& source, const Machine& machine) : source_(&source), machine_(&machine), steps_(machine) {}

    [[nodiscard]] bool next(PathElement& element) override;

private:
    /// What the step at the end of an arc means for the block beside it.
    struct Side {
        double speed = 0;  ///< that it allows [mm/s]; 0: there is none
        double reach = 0;  ///< of the block that it reaches [mm]
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
    double used_ = 0;          ///< of its length by the arc at its begin [mm]
    Side begun_;               ///< by this arc
    double passed_ = 0;        ///< arc length up to what is left of the last block [mm]
    std::deque<Bend> recent_;  ///< that a step here adds to
    std::deque<PathElement> ready_;
};

}  // namespace clsurf
