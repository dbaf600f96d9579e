#pragma once
// The contents of a program in numbers: counts, cutting length, bounds.

#include "core/geometry.h"
#include "toolpath/toolpath.h"

namespace clsurf {

struct ToolpathSummary {
    std::int64_t rapids = 0, feeds = 0, arcs = 0, splines = 0, dwells = 0;
    double cutting_length = 0;  ///< [mm] of all motions at feed
    Box3 bounds;                ///< [mm] of the motions at feed, arcs included; empty: none
};

/// O(motions).
[[nodiscard]] ToolpathSummary summarise(const Motions& motions);

}  // namespace clsurf
