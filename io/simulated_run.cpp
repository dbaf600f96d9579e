#include "io/simulated_run.h"

#include <array>
#include <string>

#include "io/owned_columns.h"

namespace clsurf::io {

Log simulate_run(const Program& program, const Machine& machine, const Vec3& start, const Progress& progress) {
    std::array<std::vector<double>, 3> commanded;
    std::array<std::vector<double>, 3> feedback;
    std::vector<std::uint32_t> lines;
    const SimulationSummary summary = simulate(
        program, machine, start,
        [&](std::span<const SimulatedPoint> points) {
            for (const SimulatedPoint& p : points) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    commanded[axis].push_back(p.commanded[static_cast<Eigen::Index>(axis)]);
                    feedback[axis].push_back(p.feedback[static_cast<Eigen::Index>(axis)]);
                }
                lines.push_back(p.line);
            }
        },
        progress);
    Log log;
    log.name = program.main().name();
    log.format = "simulated";
    log.records = static_cast<PointIndex>(lines.size());
    log.period = machine.controller.period;
    log.diagnostics = program.diagnostics;
    log.diagnostics.append(summary.diagnostics);
    OwnedColumns columns(log);
    for (std::size_t axis = 0; axis < 3; ++axis)
        columns.add("cmd." + std::string(axis_names[axis]), "mm", std::move(commanded[axis]));
    for (std::size_t axis = 0; axis < 3; ++axis)
        columns.add("fb." + std::string(axis_names[axis]), "mm", std::move(feedback[axis]));
    columns.add("line", "", std::move(lines));
    return log;
}

}  // namespace clsurf::io
