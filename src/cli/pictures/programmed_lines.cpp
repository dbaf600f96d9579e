#include "cli/pictures/programmed_lines.h"

#include <algorithm>

#include "io/readers/program_file.h"
#include "pipeline/programmed_part.h"

namespace clsurf::cli {

std::string why_no_programmed_lines(const PartOptions& options, const Part& part) {
    if (options.program == "-") return "the program came from standard input, which can be read once";
    if (part.path.kinematics != nullptr)
        return "the programmed path of rotary axes is not that of the tool in the workpiece";
    return {};
}

std::vector<std::vector<Vec3>> programmed_lines(const PartOptions& options, PointIndex most_points) {
    io::ProgramOptions how = options.program_options;
    how.coordinates = Coordinates::workpiece;
    const ProgrammedPart made = programmed_part(io::read_program(options.program, how));
    const PointIndex step = made.surface.positions.size() / most_points + 1;
    std::vector<std::vector<Vec3>> lines;
    bool joined = false;
    for (const Pass& pass : made.surface.passes) {
        if (pass.kind == PassKind::rapid) {
            joined = false;
            continue;
        }
        for (PointIndex i = pass.first; i <= pass.last; i = i < pass.last ? std::min(i + step, pass.last) : i + 1) {
            if (!joined) lines.emplace_back();
            lines.back().push_back(made.surface.positions.absolute(i));
            joined = true;
        }
    }
    return lines;
}

}  // namespace clsurf::cli
