#pragma once
// How points and lines are counted everywhere: points from 0 in 64 bits, lines of a program from 1.

#include <cstdint>
#include <limits>

namespace clsurf {

using PointIndex = std::int64_t;
using LineNumber = std::uint32_t;  ///< from 1; 0: no line

struct PointRange {
    PointIndex first = 0;
    PointIndex last = -1;  ///< inclusive; last < first: empty
    [[nodiscard]] PointIndex size() const { return last - first + 1; }
    friend bool operator==(const PointRange&, const PointRange&) = default;
};

}  // namespace clsurf
