#include "pipeline/part.h"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "mapping/map_lines.h"
#include "pipeline/placement.h"
#include "pipeline/roles.h"
#include "pipeline/state_tool_axes.h"
#include "surface/smoothing_segments.h"
#include "surface/stitch.h"

namespace clsurf {
namespace {

/// For a five-axis log without the machine's kinematics, which may be all that is missing.
void ask_for_kinematics(bool accept_unknown_tips, LineMap& lines) {
    ProgramMatch match = lines.match();
    if (accept_unknown_tips) {
        match.foreign.clear();
        return lines.set_match(std::move(match));
    }
    constexpr double most_off = 0.5;  // the program is known to be the right one, but its points are elsewhere
    if (match.foreign.empty() && match.off > most_off)
        match.foreign = fmt::format("{:.0f} % of its points lie off their lines", 100 * match.off);
    if (match.foreign.empty()) return;
    match.foreign_hint =
        "--machine FILE gives the kinematics, without which the tips are not known; --force continues anyway";
    lines.set_match(std::move(match));
}

/// The part of a log, before its path is known.
Part part_of(Log log, const PartRules& rules) {
    if (log.records == 0) throw InputError(Place::of_file(log.name), "contains no records");
    Part part;
    part.log = std::move(log);
    part.tool = rules.tool;
    part.limits = rules.limits;
    part.machine = rules.machine;
    part.derivative = rules.derivative;
    return part;
}

}  // namespace

LineMap lines_without_program(const Log& log, PointIndex count) {
    Program none;
    none.files.emplace_back();
    if (const Channel* channel = log.find("line")) return {channel->values, none, log.keep_alive};
    return {repeated_view(no_line, count), none, nullptr};
}

void refuse_foreign(const ProgramMatch& match, const Program& program, const Log& log, bool accept,
                    Diagnostics& diagnostics) {
    if (match.foreign.empty()) return;
    const Place place = Place::of_file(log.name);
    const std::string relation = match.foreign_hint.empty() ? "does not belong to " : "does not fit ";
    const std::string text = relation + program.main().name() + ": " + match.foreign;
    const std::string hint = match.foreign_hint.empty()
                                 ? "--force continues anyway; --work-offset or --machine may be missing"
                                 : match.foreign_hint;
    if (!accept) throw InputError(place, text, hint);
    diagnostics.add({Severity::warning, "map.foreign", place, text, {}});
}

Part assemble(Log log, const PartRules& rules) {
    Part part = part_of(std::move(log), rules);
    part.program.files.emplace_back();
    const Eigen::Isometry3d pose =
        zero_of(rules.poses, part.log, part.diagnostics).value_or(Eigen::Isometry3d::Identity());
    part.path = reconstruct(part.log, shown_role(part.log, rules.role), pose, rules.kinematics);
    part.diagnostics.append(part.log.diagnostics);
    part.lines = std::make_shared<const LineMap>(lines_without_program(part.log, part.path.count));
    return part;
}

Part assemble(Program program, Log log, const PartRules& rules) {
    Part part = part_of(std::move(log), rules);
    part.program = std::move(program);
    const Role role = shown_role(part.log, rules.role);
    const Kinematics* const kinematics = rules.kinematics.get();
    const Eigen::Isometry3d pose = place_tips_with(part.program, part.log, rules.poses, kinematics, part.diagnostics);
    part.path = reconstruct(part.log, role, pose, rules.kinematics);
    part.diagnostics.append(part.program.diagnostics);
    part.diagnostics.append(part.log.diagnostics);
    if (kinematics != nullptr) {
        note_poles(part.log, role, *kinematics, part.diagnostics);
    } else {
        note_rotary(part.log, role, part.diagnostics);
    }
    const Trajectory mapped = reconstruct_like(part.log, mapping_role(part.log, role), part.path);
    LineMap lines = map_lines(mapped, part.log, part.program, rules.use_line_channel, part.diagnostics, rules.identity);
    if (kinematics == nullptr && part.diagnostics.count("path.rotary") > 0)
        ask_for_kinematics(rules.accept_unknown_tips, lines);
    refuse_foreign(lines.match(), part.program, part.log, rules.accept_foreign, part.diagnostics);
    state_tool_axes(part.path, part.program, lines, part.diagnostics);
    part.lines = std::make_shared<const LineMap>(std::move(lines));
    return part;
}

void exchange_log(Part& part, Log log, const PartRules& rules) {
    if (log.records == 0) throw InputError(Place::of_file(log.name), "contains no records");
    Diagnostics diagnostics = log.diagnostics;
    if (part.path.kinematics == nullptr) note_rotary(log, part.path.role, diagnostics);
    Trajectory path = reconstruct(log, part.path.role, part.path.pose(), part.path.kinematics);
    const Trajectory mapped = reconstruct_like(log, mapping_role(log, path.role), path);
    LineMap lines = map_lines(mapped, log, part.program, rules.use_line_channel, diagnostics, rules.identity);
    if (diagnostics.count("path.rotary") > 0) ask_for_kinematics(rules.accept_unknown_tips, lines);
    state_tool_axes(path, part.program, lines, diagnostics);
    part.log = std::move(log);
    part.path = std::move(path);
    part.lines = std::make_shared<const LineMap>(std::move(lines));
    part.diagnostics = std::move(diagnostics);
}

ClSurface stitch(const Part& part) { return stitch(gather(part.path), *part.lines); }

std::vector<Trajectory> other_roles(const Part& part) {
    std::vector<Trajectory> others;
    for (const Role role : all_roles) {
        if (role != part.path.role && can_reconstruct_like(part.log, role, part.path))
            others.push_back(reconstruct_like(part.log, role, part.path));
    }
    return others;
}

std::shared_ptr<const MotionEstimate> estimate_motion(const Part& part, const Passes& pieces) {
    return estimate_motion(part.derivative, part.log, part.path, pieces);
}

}  // namespace clsurf
