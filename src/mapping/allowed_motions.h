#pragma once
// The motions on which a point may be, given the line that its log reports: a kernel changes the number at the
// beginning of a blend, and reports the last line of those that it merged into one move.

#include <algorithm>
#include <cstdint>

#include "program/program.h"

namespace clsurf {

constexpr std::int64_t longest_merge = 1000;  ///< greatest number of motions that a kernel merges

/// Motions, both ends included; empty: last < first.
struct MotionRange {
    std::int64_t first = 0, last = -1;
};

/// The motions of a point if the log was on motion `before` (−1: unknown) and now reports the line of `motion`: from
/// the motion before the last one to one after the reported one. A line that does not follow (a jump) merged nothing.
[[nodiscard]] inline MotionRange allowed_motions(std::int64_t before, std::int64_t motion, std::int64_t count) {
    const bool merged = before >= 0 && before < motion && motion - before <= longest_merge;
    const std::int64_t first = merged ? before : motion - 1;
    return {std::max<std::int64_t>(0, first - 1), std::min(count - 1, motion + 1)};
}

/// The first motion that a kernel may have merged into the one before `before`, with which a blend begins: lines
/// changed from `earlier` to `before` at once. −1: unknown.
[[nodiscard]] inline std::int64_t begin_of_merge(std::int64_t earlier, std::int64_t before) {
    const bool merged = earlier >= 0 && before - earlier > 1 && before - earlier <= longest_merge;
    return merged ? earlier : before;
}

/// How far the tool may leave the programmed path [mm]: the largest corner tolerance that the program gives; if it
/// allows blending without one, the usual deviation of a kernel at finishing feeds.
[[nodiscard]] double corner_tolerance(const Program& program);

}  // namespace clsurf
