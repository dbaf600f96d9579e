#pragma once
// Defects in subprograms with separate files: the file and its lines.

#include <vector>

#include "mapping/line_map.h"
#include "predictor/defect.h"
#include "program/program.h"

namespace clsurf {

/// Sets file, file_first_line and file_last_line of the sections inside such subprograms. O(points of the sections).
void name_subprograms(const Program& program, const LineMap& lines, std::vector<Defect>& defects);

}  // namespace clsurf
