#include "predictor/subprogram_lines.h"

#include <algorithm>

#include "core/file_name.h"

namespace clsurf {
namespace {

/// Names the lines of subprograms that are in files of their own.
void name_subprograms(const Program& program, const LineMap& lines, std::vector<DefectRun>& runs) {
    const Motions& motions = program.motions;
    for (DefectRun& run : runs) {
        std::uint16_t file = 0;  // of the first point in one
        for (PointIndex i = run.points.first; i <= run.points.last; ++i) {
            const std::int64_t motion = lines.motion_at(i);
            if (motion < 0) continue;
            const auto m = static_cast<std::size_t>(motion);
            if (file == 0) file = motions.file[m];
            if (file == 0 || motions.file[m] != file) continue;
            const LineNumber line = motions.line[m];
            run.file_first_line = run.file_first_line == 0 ? line : std::min(run.file_first_line, line);
            run.file_last_line = std::max(run.file_last_line, line);
        }
        if (file != 0) run.file = file_name(program.files[file].name());
    }
}

}  // namespace

void name_subprograms(const Program& program, const LineMap& lines, std::vector<Defect>& defects) {
    if (program.motions.file.empty()) return;
    for (Defect& defect : defects) {
        name_subprograms(program, lines, defect.runs);
        name_subprograms(program, lines, defect.neighbours);
    }
}

}  // namespace clsurf
