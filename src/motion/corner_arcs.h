#pragma once
// CornerArcs: puts a transition arc in the place of every corner that has one. The first half of an arc
// belongs to the block before, the second to the one behind.

#include <deque>

#include "motion/block_stream.h"

namespace clsurf {

class CornerArcs final : public ElementSource {
public:
    /// `share`: of the tolerance that the arcs may take. The source must outlive it.
    CornerArcs(ElementSource& source, double period, double share) : source_(&source), period_(period), share_(share) {}

    [[nodiscard]] bool next(PathElement& element) override;

private:
    void add_corner(const PathElement& after);

    ElementSource* source_;
    double period_, share_;
    bool holds_ = false;
    PathElement held_;       ///< the last block
    double used_ = 0;        ///< of its way by the arc at its begin [mm]
    std::deque<PathElement> ready_;
};

}  // namespace clsurf
