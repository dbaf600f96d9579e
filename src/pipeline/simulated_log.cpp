#include "pipeline/simulated_log.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/units.h"
#include "intervals/interval_feeds.h"
#include "simulation/run/five_axis_simulator.h"
#include "toolpath/tip_motions.h"

namespace clsurf {
namespace {

struct Columns {
    std::vector<std::vector<double>> positions;
    std::vector<LineNumber> line;
    std::vector<LimitingFactor> limit;
};

/// Makes a log from the columns that `fill` fills; `fill` returns the summary of the run. `axes`: of each role, in order.
template <typename Fill>
SimulatedRun run_to_log(const Program& program, const Machine& machine, const std::string& axes, const Fill& fill) {
    SimulatedRun run;
    auto columns = std::make_shared<Columns>();
    columns->positions.resize(2 * axes.size());
    run.summary = fill(*columns);
    Log& log = run.log;
    log.name = program.main().name() + " on " + machine.name;
    log.format = "simulation";
    log.period = machine.controller.period;
    log.records = static_cast<PointIndex>(columns->line.size());
    log.keep_alive = columns;
    const auto view = [&](const void* data, std::size_t stride, ScalarType type) {
        return ChannelView{static_cast<const std::byte*>(data), stride, log.records, type, false, 1.0, 0.0};
    };
    for (std::size_t k = 0; k < columns->positions.size(); ++k) {
        const std::size_t axis = k % axes.size();
        log.channels.push_back({(k < axes.size() ? "cmd." : "fb.") + axes.substr(axis, 1), axis < 3 ? "mm" : "deg",
                                view(columns->positions[k].data(), sizeof(double), ScalarType::f64)});
    }
    log.channels.push_back({"line", "", view(columns->line.data(), sizeof(LineNumber), ScalarType::u32)});
    static_assert(sizeof(LimitingFactor) == 1);
    log.channels.push_back({"limit", "", view(columns->limit.data(), sizeof(LimitingFactor), ScalarType::u8)});
    return run;
}

SimulatedRun five_axes_to_log(const Program& program, const Machine& machine, const Vec3& start,
                              const Progress& progress, const Vec3& zero) {
    const Kinematics& kinematics = machine.kinematics;
    const std::array<double, 5> factors{1, 1, 1, kinematics.tilt.sign * deg_per_rad,
                                        kinematics.rotation.sign * deg_per_rad};
    SimulatedRun run = run_to_log(
        program, machine, {'x', 'y', 'z', kinematics.tilt.letter, kinematics.rotation.letter}, [&](Columns& columns) {
            const auto take = [&](std::span<const FiveAxisPoint> points) {
                for (const FiveAxisPoint& p : points) {
                    for (std::size_t axis = 0; axis < factors.size(); ++axis) {
                        columns.positions[axis].push_back(p.commanded[axis] * factors[axis]);
                        columns.positions[axis + factors.size()].push_back(p.feedback[axis] * factors[axis]);
                    }
                    columns.line.push_back(p.line);
                    columns.limit.push_back(p.limit);
                }
            };
            return simulate_five_axis(program, machine, zero, start, take, progress).run;
        });
    run.log.work_offset = zero;
    return run;
}

}  // namespace

bool runs_on_five_axes(const Program& program, const Machine& machine) {
    return machine.kinematics.has_rotary() && !(program.motions.rotary.empty() && program.motions.tool_axis.empty());
}

Eigen::Isometry3d prepare_five_axes(Program& program, const Machine& machine, FramePoses poses, const Vec3& start) {
    poses.tool_by_kinematics = true;
    const Eigen::Isometry3d pose = place_motions(program, poses, Coordinates::level);
    solve_tool_axes(program, machine);
    make_tip_motions(program, machine.kinematics, -pose.translation(), start);
    return pose;
}

Eigen::Isometry3d prepare_run(Program& program, const Machine& machine, const FramePoses& poses, const Vec3& start,
                              Coordinates three_axes) {
    if (runs_on_five_axes(program, machine)) return prepare_five_axes(program, machine, poses, start);
    (void)place_motions(program, {}, three_axes);
    return Eigen::Isometry3d::Identity();
}

SimulatedRun simulate_to_log(const Program& programmed, const Machine& machine, const Vec3& start,
                             const Progress& progress, const Vec3& zero) {
    std::optional<Program> held;
    if (machine.controller.feed == FeedRule::intervals) hold_interval_speeds(held.emplace(programmed), machine);
    const Program& program = held ? *held : programmed;
    if (runs_on_five_axes(program, machine)) return five_axes_to_log(program, machine, start, progress, zero);
    return run_to_log(program, machine, "xyz", [&](Columns& columns) {
        const auto take = [&](std::span<const SimulatedPoint> points) {
            for (const SimulatedPoint& p : points) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    columns.positions[axis].push_back(p.commanded[static_cast<Eigen::Index>(axis)]);
                    columns.positions[axis + 3].push_back(p.feedback[static_cast<Eigen::Index>(axis)]);
                }
                columns.line.push_back(p.line);
                columns.limit.push_back(p.limit);
            }
        };
        return simulate(program, machine, start, take, progress);
    });
}

}  // namespace clsurf
