#include "cli/programs/simulated_cut.h"

#include <vector>

#include <fmt/format.h>

#include "intervals/interval_feeds.h"
#include "scan/read_back.h"
#include "simulation/run/simulator.h"

namespace clsurf::cli {

io::SimulatedCut simulated_cut(Program& program, const ScanCut& cut, double tolerance, const Machine& machine) {
    if (machine.controller.feed == FeedRule::intervals) hold_interval_speeds(program, machine);
    const auto [first, last] = lines_of_cut(program);
    std::vector<Vec2> places;
    const PointSink keep = [&, from = first, to = last](std::span<const SimulatedPoint> points) {
        for (const SimulatedPoint& point : points) {
            if (point.line >= from && point.line <= to) places.emplace_back(point.commanded.x(), point.commanded.z());
        }
    };
    const SimulationSummary run = simulate(program, machine, Vec3::Zero(), keep);
    program.diagnostics.append(run.diagnostics);
    io::SimulatedCut simulated{machine.name, 0, tolerance + machine.controller.tolerance, run.duration};
    if (places.size() > 1) simulated.deviation = distance_from(cut.path, places);
    if (simulated.deviation > simulated.allowed)
        program.diagnostics.add(
            {Severity::warning, "profile.simulated", Place::of_file(program.main().name()),
             fmt::format(
                 "simulated on {}, the tool is {:.4f} mm away from the fit; tolerance and corners allow {:.4f} mm",
                 simulated.machine, simulated.deviation, simulated.allowed),
             "a smaller --tolerance, a lower --feed, or a smaller tolerance of corners in the machine file"});
    return simulated;
}

}  // namespace clsurf::cli
