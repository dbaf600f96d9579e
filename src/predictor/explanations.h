#pragma once
// Explanations: heights at places where the motion differs are the effect of that motion.

#include <cstddef>
#include <span>
#include <vector>

#include "predictor/candidates.h"
#include "predictor/defect.h"

namespace clsurf {

class Explanations {
public:
    /// Adds something that was found. `room`: points round a run that are its own too.
    void add(const std::vector<DefectRun>& runs, PointIndex room);

    /// At least half of the sites, in the order of their points, lie in sections of what was added: of one thing or of several,
    /// as where every level of a tower has a link of its own. O(sites log runs), and at the first call O(runs log runs).
    [[nodiscard]] bool explain(std::span<const DefectCandidate* const> sites);

private:
    struct Section {
        PointIndex first, last;
        PointIndex farthest;  ///< last of this one and all before
    };
    void sort();

    std::vector<Section> sections_;
    bool sorted_ = true;
};

}  // namespace clsurf
