#pragma once
// CornerArcs: replaces every corner that has a transition arc by this arc. The first half of an arc belongs to
// the block before the corner, the second half to the block after it.

#include <deque>

#include "simulation/path/block_stream.h"

namespace clsurf {

class CornerArcs final : public ElementSource {
public:
    /// The source must outlive it.
    CornerArcs(ElementSource& source, double period) : source_(&source), period_(period) {}

    [[nodiscard]] bool next(PathElement& element) override;

private:
    void add_corner(const PathElement& after);

    ElementSource* source_;
    double period_;
    bool holds_ = false;
    PathElement held_;  ///< the last block
    double used_ = 0;   ///< of its way by the arc at its begin [mm]
    std::deque<PathElement> ready_;
};

}  // namespace clsurf
