#pragma once
// Comparison of a written program with the path for which it was written.

#include <span>
#include <utility>

#include "program/program.h"
#include "scan/cut_path.h"

namespace clsurf {

struct ReadBack {
    std::size_t motions = 0;  ///< at feed, without the approach
    double deviation = 0;     ///< [mm] the greatest distance between both, in both directions
};

/// [mm] the greatest distance between a path and the places of a tool along it, in both directions. `places`: at least two,
/// in their order.
[[nodiscard]] double distance_from(const CutPath& path, std::span<const Vec2> places);
/// Lines of the motions along the path, without approach and retract. `program`: from cut_program.h, parsed.
[[nodiscard]] std::pair<LineNumber, LineNumber> lines_of_cut(const Program& program);

/// `program`: from cut_program.h, parsed. Throws InputError if it does not move at feed.
[[nodiscard]] ReadBack read_back(const Program& program, const CutPath& path);

}  // namespace clsurf
