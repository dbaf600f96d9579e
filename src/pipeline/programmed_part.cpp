#include "pipeline/programmed_part.h"

#include <utility>

#include "core/error.h"
#include "pipeline/simulated_log.h"
#include "surface/programmed_surface.h"

namespace clsurf {

ProgrammedPart programmed_part(Program program) {
    ProgrammedSurface programmed = build_programmed_surface(program);
    ProgrammedPart made;
    Part& part = made.part;
    part.lines = std::make_shared<const LineMap>(lines_of(programmed, program));
    part.log.records = programmed.surface.positions.size();
    part.log.name = program.main().name();
    part.path.count = part.log.records;
    part.diagnostics = program.diagnostics;
    part.program = std::move(program);
    made.surface = std::move(programmed.surface);
    return made;
}

SimulatedPart simulated_part(Program program, PartRules rules, const Vec3& start, const Progress& progress) {
    const Machine machine = rules.machine ? *rules.machine : Machine{};
    if (!runs_on_five_axes(program, machine)) {
        if (rules.poses.zero && !rules.poses.zero_is_default)
            throw UsageError(
                "a work offset is for programs that run on five axes; on three the program's own work offsets count");
        rules.poses = {};
        rules.kinematics = nullptr;
    }
    Program placed = program;
    const Eigen::Isometry3d pose = prepare_run(placed, machine, rules.poses, start);
    SimulatedRun run = simulate_to_log(placed, machine, start, progress, pose.translation());
    return {assemble(std::move(program), std::move(run.log), rules), std::move(run.summary)};
}

}  // namespace clsurf
