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

    /// At least half of the sites, in the order of their points, lie in the sections of one that was added. O(sites log runs), and
    /// at the first call O(runs log runs).
    [[nodiscard]] bool explain(std::span<const DefectCandidate* const> sites);

private:
    struct Section {
        PointIndex first, last;
        PointIndex farthest;  ///< last of this one and all before
        std::size_t found;
    };
    void sort();

    std::vector<Section> sections_;
    std::size_t added_ = 0;
    bool sorted_ = true;
};

}  // namespace clsurf
