#include "program/motion.h"

#include <algorithm>

namespace clsurf {

const Arc* Motions::arc_of(std::int64_t i) const {
    const auto found = std::lower_bound(arcs.begin(), arcs.end(), i,
                                        [](const Arc& arc, std::int64_t m) { return arc.motion < m; });
    return found != arcs.end() && found->motion == i ? &*found : nullptr;
}

}  // namespace clsurf
