#pragma once
// Passes: the trajectory cut into pieces. A pass is a maximal run of cutting points whose neighbour
// passes lie to the side, not ahead; what joins passes are links and rapids.

#include <cstdint>

#include "core/column.h"
#include "core/point.h"

namespace clsurf {

enum class PassKind : std::uint8_t { cut, link, rapid };

struct Pass {
    PointIndex first = 0;
    PointIndex last = -1;  ///< inclusive
    PassKind kind = PassKind::cut;
    [[nodiscard]] PointIndex size() const { return last - first + 1; }
};

/// All pieces in order; together they cover every point of the trajectory exactly once.
using Passes = Column<Pass>;

}  // namespace clsurf
