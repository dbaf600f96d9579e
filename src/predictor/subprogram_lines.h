#pragma once
// Defects inside subprograms that are in files of their own: which lines of which file.

#include <vector>

#include "mapping/line_map.h"
#include "predictor/defect.h"
#include "program/program.h"

namespace clsurf {

/// Sets file, file_first_line and file_last_line of the sections that run there. O(points of the sections).
void name_subprograms(const Program& program, const LineMap& lines, std::vector<Defect>& defects);

}  // namespace clsurf
