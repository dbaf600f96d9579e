#pragma once
// Border: where the border of a part explains a difference, and where it does not.
//
// The outermost passes have a neighbour on one side only. They differ, and so do passes that begin or end next to one that goes
// on. Such candidates are marked (DefectCandidate::border), and the defects that they form are expected. This has two limits: a
// difference next to a border site is a defect unless it is the flank of that site, and so is a difference at the border that
// stands out clearly.

#include "predictor/candidates.h"
#include "toolpath/arc_length.h"

namespace clsurf {

class Border {
public:
    /// All must outlive it. `candidates`: in the order of their points. `along`: joined_along().
    Border(const ClSurface& surface, const Signals& signals, const ArcLength& arc_length,
           const DefectCandidates& candidates, double along, const Thresholds& thresholds);

    /// The border site whose flank the sites of `core` may be: at least as strong as their strongest site, and next to it along
    /// the pass or across. nullptr if there is none. O(sites + log candidates).
    [[nodiscard]] const DefectCandidate* flank_of(const DefectCandidates& core, Quantity quantity) const;

    /// How far [mm] a flank reaches from there: the length that the tool needs to make up the difference with the usual
    /// acceleration.
    [[nodiscard]] double flank_reach(const DefectCandidates& core, Quantity quantity) const;

    /// Whether a site belongs to the flank of the border site `at`: it is next to `at`, or it is within `reach` [mm] and a ramp
    /// causes the difference. In speed, a ramp needs an acceleration of this pass or of an adjacent one. In height, the
    /// difference must be smaller than at the border.
    [[nodiscard]] bool on_flank(const DefectCandidate& site, const DefectCandidate& at, double reach,
                                Quantity quantity) const;

    /// Whether sites at the border differ clearly over a section, while their pass goes on before and after it. Clearly: step
    /// and residual are at least twice the threshold, and the site is compared with three passes or more, or is slower than
    /// passes that begin or end next to it. Sites in corners do not count, because passes that go around the corner are no
    /// reference. O(sites).
    [[nodiscard]] bool stands_out(const DefectCandidates& core, Quantity quantity) const;

private:
    [[nodiscard]] const DefectCandidate* find_as_strong(PointIndex point, std::size_t pass, float share,
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
