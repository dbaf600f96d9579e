#pragma once
// Which motions a point may lie on whose log reports a line: a kernel changes the number where a
// blend begins, and reports the last line of those that it merged into one move.

#include <algorithm>
#include <cstdint>

#include "path/line_map.h"
#include "path/toolpath.h"

namespace clsurf {

/// Calls body(first, last), both inclusive, for the motions that `line` allows where `before` is the
/// line reported before it; stops when body says true. One range for each time that the line runs.
template <typename Body>
void for_allowed_motions(const Toolpath& path, const LineMap& map, LineNumber before, LineNumber line, Body&& body) {
    constexpr std::int64_t longest_merge = 1000;  // motions that a kernel makes one of
    for (const std::uint32_t motion : map.motions_of(line)) {
        // Back over the motions that were merged into this one, to the line reported before it.
        std::int64_t first = std::int64_t{motion} - 1;
        while (first > 0 && motion - first < longest_merge &&
               path.motions().line[static_cast<std::size_t>(first)] != before) {
            --first;
        }
        // A line that does not follow the one before (a loop, a jump) merged nothing.
        if (first >= 0 && path.motions().line[static_cast<std::size_t>(first)] != before) {
            first = std::int64_t{motion} - 1;
        }
        const std::int64_t last = std::min<std::int64_t>(path.size() - 1, std::int64_t{motion} + 1);
        if (body(std::max<std::int64_t>(0, first - 1), last)) return;
    }
}

}  // namespace clsurf
