#include "optimize/run.h"

#include <array>
#include <cmath>
#include <vector>

#include "core/statistics.h"
#include "path/pieces.h"
#include "quality/quality_fields.h"

namespace clsurf {
namespace {

struct Columns {
    std::array<std::vector<double>, 6> positions;
    std::vector<LineNumber> line;
};

}  // namespace

SimulatedRun simulate_to_log(const Program& program, const Machine& machine, const Vec3& start,
                             const Progress& progress) {
    SimulatedRun run;
    auto columns = std::make_shared<Columns>();
    run.summary = simulate(
        program, machine, start,
        [&](std::span<const SimulatedPoint> points) {
            for (const SimulatedPoint& p : points) {
                for (int axis = 0; axis < 3; ++axis) {
                    columns->positions[static_cast<std::size_t>(axis)].push_back(p.commanded[axis]);
                    columns->positions[static_cast<std::size_t>(axis + 3)].push_back(p.feedback[axis]);
                }
                columns->line.push_back(p.line);
            }
        },
        progress);
    Log& log = run.log;
    log.name = program.main().name() + " on " + machine.name;
    log.format = "simulation";
    log.period = machine.controller.period;
    log.records = static_cast<PointIndex>(columns->line.size());
    log.keep_alive = columns;
    constexpr std::array<const char*, 6> names{"cmd.x", "cmd.y", "cmd.z", "fb.x", "fb.y", "fb.z"};
    const auto view = [&](const void* data, std::size_t stride, ScalarType type) {
        return ChannelView{static_cast<const std::byte*>(data), stride, log.records, type, false, 1.0, 0.0};
    };
    for (std::size_t k = 0; k < names.size(); ++k)
        log.channels.push_back({names[k], "mm", view(columns->positions[k].data(), sizeof(double), ScalarType::f64)});
    log.channels.push_back({"line", "", view(columns->line.data(), sizeof(LineNumber), ScalarType::u32)});
    return run;
}

JudgedRun judge_run(Log log, const Program& program, const QualityRules& rules, Diagnostics& diagnostics) {
    JudgedRun run;
    run.log = std::move(log);
    const Role role = run.log.has(Role::commanded)  ? Role::commanded
                      : run.log.has(Role::feedback) ? Role::feedback
                                                    : Role::actual;
    const Vec3 offset = -run.log.work_offset.value_or(Vec3::Zero());
    run.path = reconstruct(run.log, role, offset);
    run.lines = std::make_unique<LineMap>(map_lines(run.path, run.log, program, true, diagnostics));
    run.surface = stitch(gather(run.path), *run.lines);
    const bool follows = role == Role::commanded && run.log.has(Role::feedback);
    const Trajectory measured = follows ? reconstruct(run.log, Role::feedback, offset) : Trajectory{};
    run.signals = derive_signals(run.surface, run.path, follows ? &measured : nullptr,
                                 smooth_pieces(run.log, run.surface.passes), usual_end_zone(run.surface.step_over));
    run.report = find_defects(run.surface, run.signals, *run.lines, program, run.log.period, rules);
    run.duration = static_cast<double>(std::max<PointIndex>(0, run.log.records - 1)) * run.log.period;
    run.speed_differences = quality_field("speed_mismatch", run.surface, run.signals).values;
    std::vector<float> sizes;
    for (const float value : run.speed_differences) {
        if (value == value) sizes.push_back(std::abs(value));
    }
    if (sizes.empty()) return run;
    run.mismatch = quantile_below(sizes, 0.95);
    run.greatest_mismatch = quantile_below(sizes, 0.999);
    return run;
}

}  // namespace clsurf
