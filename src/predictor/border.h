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

    /// The border site whose flank the sites of `core` may be: as strong as their strongest one or stronger, and next to it
    /// along the pass or across. nullptr if there is none. O(sites + log candidates).
    [[nodiscard]] const DefectCandidate* flank_of(const DefectCandidates& core, Quantity quantity) const;

    /// How far [mm] a flank reaches from there: as far as the tool needs to make up the difference with the usual acceleration.
    [[nodiscard]] double flank_reach(const DefectCandidates& core, Quantity quantity) const;

    /// Whether a site belongs to the flank of the border site `at`: it is next to `at`, or it is within `reach` [mm] and a ramp
    /// causes the difference. In speed, a ramp needs an acceleration of this pass or of an adjacent one. In height, the
    /// difference must be smaller than at the border.
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
