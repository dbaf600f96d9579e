#include "predictor/subprogram_lines.h"

#include <algorithm>

#include "core/file_name.h"

namespace clsurf {
namespace {

/// Sets the file and lines of sections in subprograms with separate files.
void name_subprograms(const Program& program, const LineMap& lines, std::vector<DefectSection>& sections) {
    const Motions& motions = program.motions;
    for (DefectSection& section : sections) {
        std::uint16_t file = 0;  // of the first point in a subprogram
        for (PointIndex i = section.points.first; i <= section.points.last; ++i) {
            const std::int64_t motion = lines.motion_at(i);
            if (motion < 0) continue;
            const auto m = static_cast<std::size_t>(motion);
            if (file == 0) file = motions.file[m];
            if (file == 0 || motions.file[m] != file) continue;
            const LineNumber line = motions.line[m];
            section.file_first_line = section.file_first_line == 0 ? line : std::min(section.file_first_line, line);
            section.file_last_line = std::max(section.file_last_line, line);
        }
        if (file != 0) section.file = file_name(program.files[file].name());
    }
}

}  // namespace

void name_subprograms(const Program& program, const LineMap& lines, std::vector<Defect>& defects) {
    if (program.motions.file.empty()) return;
    for (Defect& defect : defects) {
        name_subprograms(program, lines, defect.sections);
        name_subprograms(program, lines, defect.neighbours);
    }
}

}  // namespace clsurf
