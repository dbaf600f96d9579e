#pragma once
// What a written program does, compared with the path that it was written for.

#include "program/program.h"
#include "scan/cut_path.h"

namespace clsurf {

struct ReadBack {
    std::size_t motions = 0;  ///< at feed, without the approach
    double deviation = 0;     ///< [mm] the greatest distance between both, each from the other
};

/// `program`: of cut_program.h, read. Throws InputError where it does not move at feed.
[[nodiscard]] ReadBack read_back(const Program& program, const CutPath& path);

}  // namespace clsurf
