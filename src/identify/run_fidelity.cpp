#include "identify/run_fidelity.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <unordered_set>
#include <utility>

#include "core/cell_grid.h"
#include "core/statistics.h"
#include "mapping/map_lines.h"
#include "pipeline/judge.h"
#include "pipeline/roles.h"
#include "pipeline/signals_of.h"
#include "pipeline/simulated_log.h"
#include "toolpath/positions.h"

namespace clsurf {
namespace {

std::optional<double> ratio_of(std::size_t found, std::size_t all) {
    if (all == 0) return std::nullopt;
    return static_cast<double>(found) / static_cast<double>(all);
}

ComparedRun compared(const Part& part, const Part& other) {
    ComparedRun run;
    run.log = &part.log;
    const Role role = common_role(part.log, other.log).value_or(part.path.role);
    run.path = reconstruct_like(part.log, role, part.path);
    if (part.log.has(Role::commanded) && other.log.has(Role::commanded))
        run.commanded = reconstruct_like(part.log, Role::commanded, part.path);
    if (const std::optional<Role> measured = common_measured_role(part.log, other.log))
        run.measured = reconstruct_like(part.log, *measured, part.path);
    return run;
}

/// Range from the first to the last motion; the rests before and after do not belong to a run.
PointRange moving(const Positions& p) {
    constexpr float still = 1e-3F;  // mm: above any rounding of a commanded position
    PointRange range{0, p.size() - 1};
    while (range.size() > 1 && !((p[range.first] - p[0]).norm() > still)) ++range.first;
    while (range.size() > 1 && !((p[range.last] - p[p.size() - 1]).norm() > still)) --range.last;
    return range;
}

struct Durations {
    double logged = 0, simulated = 0;  // s
};

double arc_length(const Positions& p) {
    double sum = 0;
    for (PointIndex i = 1; i < p.size(); ++i) sum += static_cast<double>((p[i] - p[i - 1]).norm());
    return sum;
}

/// Durations of the whole runs if both are aligned, else of the aligned sections: a log may contain only a part of the
/// program.
Durations durations_of(const Part& a, const Part& b, const RunAlignment& alignment) {
    constexpr double whole = 0.99;
    const Positions of_b = gather(b.path);
    const PointRange moving_a = moving(gather(a.path)), moving_b = moving(of_b);
    if (alignment.aligned >= whole * alignment.arc_length && alignment.aligned >= whole * arc_length(of_b))
        return {static_cast<double>(moving_a.size()) * a.log.period,
                static_cast<double>(moving_b.size()) * b.log.period};
    Durations sum;
    for (const PointRange& section : alignment.sections) {
        const PointRange both{std::max(section.first, moving_a.first), std::min(section.last, moving_a.last)};
        if (both.size() < 2) continue;
        const auto at = [&](PointIndex i) {
            const PathLocation& place = alignment.locations[static_cast<std::size_t>(i)];
            return static_cast<double>(place.point) + static_cast<double>(place.fraction);
        };
        sum.logged += static_cast<double>(both.size() - 1) * a.log.period;
        sum.simulated += (at(both.last) - at(both.first)) * b.log.period;
    }
    return sum;
}

/// Values along a path, each weighted with its length.
class AlongPath {
public:
    void add(double value, double length) {
        if (value == value && length > 0) values_.push_back({std::abs(value), length});
    }
    [[nodiscard]] bool empty() const { return values_.empty(); }
    /// The |value| that is not exceeded on a share of the path. Domain: not empty.
    [[nodiscard]] double quantile(double share) { return weighted_quantile(values_, share); }

private:
    std::vector<std::pair<double, double>> values_;
};

/// The following error of the log on the compared sections.
std::optional<double> following_error(const Part& part, const RunDifferences& differences, const Positions& positions) {
    const std::optional<Role> measured = measured_role(part.log, part.path);
    if (!measured || !part.log.has(Role::commanded) || !differences.has(RunQuantity::following_error))
        return std::nullopt;
    const Positions commanded = gather(reconstruct_like(part.log, Role::commanded, part.path));
    const Positions fed_back = gather(reconstruct_like(part.log, *measured, part.path));
    const Eigen::Vector3f apart = (fed_back.origin - commanded.origin).cast<float>();
    AlongPath errors;
    const Column<float>& lag = differences.of[index_of(RunQuantity::following_error)];
    for (PointIndex i = 1; i < positions.size(); ++i) {
        if (std::isnan(lag[static_cast<std::size_t>(i)])) continue;
        errors.add((fed_back[i] - commanded[i] + apart).norm(), (positions[i] - positions[i - 1]).norm());
    }
    if (errors.empty()) return std::nullopt;
    return errors.quantile(0.95);
}

/// The places of defects, in cells.
class DefectPlaces {
public:
    DefectPlaces(const QualityReport& report, const Positions& positions, double cell)
        : report_(&report), positions_(&positions), grid_(cell) {
        for (const Defect& defect : report.defects) {
            if (defect.systematic) {
                systematic_ = true;
                continue;
            }
            visit(defect, [&](CellGrid::Key at) { return cells_.insert(at), false; });
        }
    }

    /// Number of these defects that `others` has within a cell. A defect that covers the whole part matches any other such
    /// defect.
    [[nodiscard]] std::size_t found_in(const DefectPlaces& others) const {
        std::size_t found = 0;
        for (const Defect& defect : report_->defects) {
            const bool has = defect.systematic ? others.systematic_
                                               : visit(defect, [&](CellGrid::Key at) { return others.is_near(at); });
            if (has) ++found;
        }
        return found;
    }

private:
    [[nodiscard]] bool is_near(CellGrid::Key at) const {
        bool found = false;
        CellGrid::for_each_near(at, 1, [&](CellGrid::Key cell) { found = found || cells_.contains(cell); });
        return found;
    }
    /// Calls f(cell) for each point of the defect's sections, until it returns true.
    template <typename F>
    bool visit(const Defect& defect, F&& f) const {
        for (const DefectSection& section : defect.sections)
            for (PointIndex i = section.points.first; i <= section.points.last; ++i)
                if (f(grid_.key(positions_->absolute(i)))) return true;
        return false;
    }

    const QualityReport* report_;
    const Positions* positions_;
    CellGrid grid_;
    bool systematic_ = false;
    std::unordered_set<CellGrid::Key> cells_;
};

void compare_defects(const Part& part, const ClSurface& surface, const Part& simulation, RunFidelity& out) {
    const QualityReport logged = find_defects(part, surface, signals_of(part, surface));
    const ClSurface simulated_surface = stitch(simulation);
    QualityRules rules;
    rules.fixed = logged.thresholds;
    const QualityReport simulated =
        find_defects(simulation, simulated_surface, signals_of(simulation, simulated_surface), rules);
    constexpr double least_cell = 0.5;  // mm
    const double cell = std::max(least_cell, logged.step_over);
    const DefectPlaces in_log(logged, surface.positions, cell);
    const DefectPlaces in_simulation(simulated, simulated_surface.positions, cell);
    out.defects_logged = logged.defects.size();
    out.defects_simulated = simulated.defects.size();
    out.logged_found = in_log.found_in(in_simulation);
    out.simulated_found = in_simulation.found_in(in_log);
}

}  // namespace

std::optional<double> RunFidelity::recall() const { return ratio_of(logged_found, defects_logged); }
std::optional<double> RunFidelity::precision() const { return ratio_of(simulated_found, defects_simulated); }

RecordedRun::RecordedRun(const Part& part) : part_(&part), surface_(stitch(part)) {}

Part RecordedRun::simulated(const Machine& machine) const {
    Part simulation;
    simulation.program = part_->program;
    const Eigen::Isometry3d pose = part_->path.pose();
    const bool five_axes = part_->path.kinematics != nullptr && runs_on_five_axes(part_->program, machine);
    const Vec3 zero = five_axes ? Vec3(pose.translation()) : Vec3::Zero();
    simulation.log = simulate_to_log(part_->program, machine, part_->path.at(0), {}, zero).log;
    if (!measured_role(part_->log, part_->path))
        std::erase_if(simulation.log.channels, [](const auto& channel) { return channel.name.starts_with("fb."); });
    simulation.path = five_axes ? reconstruct(simulation.log, Role::commanded, pose, part_->path.kinematics)
                                : reconstruct(simulation.log, Role::commanded, Vec3::Zero());
    simulation.lines = std::make_shared<const LineMap>(
        map_lines(simulation.path, simulation.log, simulation.program, true, simulation.diagnostics));
    return simulation;
}

RunDifferences RecordedRun::differences(const Part& simulation) const {
    return compare_runs(compared(*part_, simulation), surface_, compared(simulation, *part_));
}

RunFidelity RecordedRun::fidelity(const Machine& machine) const {
    const Part simulation = simulated(machine);
    const RunDifferences found = differences(simulation);
    RunFidelity out;
    out.log = part_->log.name;
    const Durations durations = durations_of(*part_, simulation, found.alignment);
    out.duration = durations.logged;
    out.simulated_duration = durations.simulated;
    if (durations.logged > 0) out.time_error = durations.simulated / durations.logged - 1;
    if (found.alignment.arc_length > 0) out.compared = found.alignment.aligned / found.alignment.arc_length;
    out.usual_speed = static_cast<double>(found.usual_speed);
    const Positions& positions = surface_.positions;
    AlongPath speeds, lags;
    for (PointIndex i = 1; i < positions.size(); ++i) {
        const auto at = static_cast<std::size_t>(i);
        const double length = (positions[i] - positions[i - 1]).norm();
        speeds.add(found.of[index_of(RunQuantity::speed)][at], length);
        if (found.has(RunQuantity::following_error))
            lags.add(found.of[index_of(RunQuantity::following_error)][at], length);
    }
    if (!speeds.empty()) {
        out.speed_error_p50 = speeds.quantile(0.5);
        out.speed_error_p95 = speeds.quantile(0.95);
    }
    if (!lags.empty()) out.following_error_p95 = lags.quantile(0.95);
    out.following_error = following_error(*part_, found, positions);
    compare_defects(*part_, surface_, simulation, out);
    return out;
}

std::optional<Fidelity> summary_of(std::span<const RunFidelity> runs, FidelityBasis basis) {
    if (runs.empty()) return std::nullopt;
    Fidelity worst;
    worst.basis = basis;
    worst.runs = static_cast<int>(runs.size());
    std::size_t logged = 0, logged_found = 0, simulated = 0, simulated_found = 0;
    const auto raise = [](std::optional<double>& value, double other) { value = std::max(value.value_or(0), other); };
    for (const RunFidelity& run : runs) {
        if (std::abs(run.time_error) > std::abs(worst.time_error)) worst.time_error = run.time_error;
        worst.speed_error_p50 = std::max(worst.speed_error_p50, run.speed_error_p50);
        worst.speed_error_p95 = std::max(worst.speed_error_p95, run.speed_error_p95);
        if (run.usual_speed > 0)
            worst.speed_error_p95_ratio = std::max(worst.speed_error_p95_ratio, run.speed_error_p95 / run.usual_speed);
        if (run.following_error_p95) raise(worst.following_error_p95, *run.following_error_p95);
        if (run.following_error_p95 && run.following_error.value_or(0) > 0)
            raise(worst.following_error_ratio, *run.following_error_p95 / *run.following_error);
        logged += run.defects_logged;
        logged_found += run.logged_found;
        simulated += run.defects_simulated;
        simulated_found += run.simulated_found;
    }
    worst.defects_recall = ratio_of(logged_found, logged);
    worst.defects_precision = ratio_of(simulated_found, simulated);
    return worst;
}

}  // namespace clsurf
