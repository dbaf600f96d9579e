#include "pipeline/programmed_part.h"

#include <utility>

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

Part simulated_part(Program program, PartRules rules, const Progress& progress) {
    const Machine machine = rules.machine ? *rules.machine : Machine{};
    Program placed = program;
    Vec3 zero = Vec3::Zero();
    if (runs_on_five_axes(placed, machine)) {
        zero = prepare_five_axes(placed, machine, rules.poses).translation();
    } else {
        (void)place_motions(placed, {}, Coordinates::machine);
        rules.poses = {};
        rules.kinematics = nullptr;
    }
    SimulatedRun run = simulate_to_log(placed, machine, Vec3::Zero(), progress, zero);
    run.log.diagnostics.append(run.summary.diagnostics);
    return assemble(std::move(program), std::move(run.log), rules);
}

}  // namespace clsurf
