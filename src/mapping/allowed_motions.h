#pragma once
// Which motions a point may lie on whose log reports a line: a kernel changes the number where a
// blend begins, and reports the last line of those that it merged into one move.

#include <algorithm>
#include <cstdint>

#include "program/program.h"

namespace clsurf {

constexpr std::int64_t longest_merge = 1000;  ///< motions that a kernel makes one of

/// Motions, both ends included; empty: last < first.
struct MotionRange {
    std::int64_t first = 0, last = -1;
};

/// Where the log was on motion `before` (−1: not known) and now reports the line of `motion`: from the motion
/// before the last one to one behind the reported one. A line that does not follow (a jump) merged nothing.
[[nodiscard]] inline MotionRange allowed_motions(std::int64_t before, std::int64_t motion, std::int64_t count) {
    const bool merged = before >= 0 && before < motion && motion - before <= longest_merge;
    const std::int64_t first = merged ? before : motion - 1;
    return {std::max<std::int64_t>(0, first - 1), std::min(count - 1, motion + 1)};
}

/// Where the motions begin that a kernel may have merged into the one before `before`, which a blend begins on: lines
/// went from `earlier` to `before` at once. −1: not known.
[[nodiscard]] inline std::int64_t begin_of_merge(std::int64_t earlier, std::int64_t before) {
    const bool merged = earlier >= 0 && before - earlier > 1 && before - earlier <= longest_merge;
    return merged ? earlier : before;
}

/// How far the tool may leave the programmed path [mm]: the largest corner tolerance that the program gives, and
/// where it allows blending without one, what a kernel takes at finishing feeds.
[[nodiscard]] double corner_tolerance(const Program& program);

}  // namespace clsurf
