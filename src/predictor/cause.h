#pragma once
// The cause of a difference between passes, from the shape of the mismatch along the pass and from the program
// at this place.

#include <span>

#include "mapping/line_map.h"
#include "predictor/candidates.h"
#include "predictor/defect.h"
#include "toolpath/toolpath.h"

namespace clsurf {

class CauseFinder {
public:
    /// All must outlive it.
    CauseFinder(const ClSurface& surface, const Signals& signals, const LineMap& lines, const Program& program,
                const ArcLength& arc_length)
        : surface_(surface),
          signals_(signals),
          lines_(lines),
          toolpath_(program.motions, Vec3::Zero()),
          arc_length_(arc_length) {}

    /// `sites`: the sites of the defect's sections, in order. The neighbours of the defect must be known.
    [[nodiscard]] Cause cause_of(const Defect& defect, std::span<const DefectCandidate* const> sites) const;

private:
    [[nodiscard]] bool spaced_otherwise(const Defect& defect) const;
    [[nodiscard]] bool leaves_program(const Defect& defect, std::span<const DefectCandidate* const> sites) const;
    [[nodiscard]] double off_program(PointIndex point) const;
    [[nodiscard]] bool turns(const DefectSection& section) const;
    [[nodiscard]] bool begins_with_reversal(const DefectSection& section) const;
    [[nodiscard]] double spacing(std::span<const DefectSection> sections) const;

    const ClSurface& surface_;
    const Signals& signals_;
    const LineMap& lines_;
    Toolpath toolpath_;
    const ArcLength& arc_length_;
};

}  // namespace clsurf
