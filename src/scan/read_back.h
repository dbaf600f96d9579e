#pragma once
// What a written program does, compared with the path that it was written for.

#include <span>
#include <utility>

#include "program/program.h"
#include "scan/cut_path.h"

namespace clsurf {

struct ReadBack {
    std::size_t motions = 0;  ///< at feed, without the approach
    double deviation = 0;     ///< [mm] the greatest distance between both, each from the other
};

/// [mm] the greatest distance between a path and the places that a tool went through along it, each from the other. `places`: at
/// least two, in their order.
[[nodiscard]] double distance_from(const CutPath& path, std::span<const Vec2> places);
/// Lines of the motions along the path, without those of approach and retract. `program`: of cut_program.h, read.
[[nodiscard]] std::pair<LineNumber, LineNumber> lines_of_cut(const Program& program);

/// `program`: of cut_program.h, read. Throws InputError where it does not move at feed.
[[nodiscard]] ReadBack read_back(const Program& program, const CutPath& path);

}  // namespace clsurf
