#pragma once
// Border: where a part's border explains a difference, and where it does not.
//
// The outermost passes have a neighbour on one side only, and where a pass begins or ends beside one that goes on, both
// differ: candidates are marked so (DefectCandidate::border), and what they make is expected. Expected is no more than that: what
// lies beside it is a defect of its own unless it is its flank, and what stands out of it is a defect, too.

#include "predictor/candidates.h"
#include "toolpath/arc_length.h"

namespace clsurf {

class Border {
public:
    /// All must outlive it. `candidates` in the order of their points; `along`: joined_along().
    Border(const ClSurface& surface, const Signals& signals, const ArcLength& arc_length,
           const DefectCandidates& candidates, double along, const Thresholds& thresholds);

    /// Where sites away from the border are the flank of something at it: their strongest one lies next to a site of the border
    /// that is as strong or stronger, along the pass or beside it. That one; null: there is none. O(sites + log candidates).
    [[nodiscard]] const DefectCandidate* flank_of(const DefectCandidates& core, Quantity quantity) const;

    /// How far [mm] a flank reaches from there: as far as the tool needs to make up the difference with the usual acceleration.
    [[nodiscard]] double flank_reach(const DefectCandidates& core, Quantity quantity) const;

    /// A site belongs to the flank of the site `at` of the border: it lies next to it, or within `reach` and a ramp makes the
    /// difference. Where neither the tool nor those beside it speed up or slow down, no ramp does; and a height that a ramp
    /// makes falls with the distance from the border.
    [[nodiscard]] bool on_flank(const DefectCandidate& site, const DefectCandidate& at, double reach,
                                Quantity quantity) const;

    /// Sites at the border differ clearly over a section, while their pass does not before and after it: step and residual are twice the
    /// threshold against three passes or more, or slower than passes that begin or end beside it, where it goes on. Sites in corners do not count: the
    /// passes that go round them are no measure.
    /// O(sites).
    [[nodiscard]] bool stands_out(const DefectCandidates& core, Quantity quantity) const;

private:
    [[nodiscard]] const DefectCandidate* as_strong_near(PointIndex point, std::size_t pass, float share,
                                                        Quantity quantity) const;
    [[nodiscard]] bool ramps(PointIndex point) const;
    [[nodiscard]] bool goes_on(PointIndex point, int direction) const;

    const ClSurface& surface_;
    const Signals& signals_;
    const ArcLength& arc_length_;
    double along_;
    const Thresholds& thresholds_;
    DefectCandidates at_border_;  ///< in the order of their points
};

}  // namespace clsurf
