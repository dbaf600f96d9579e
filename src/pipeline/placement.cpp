#include "pipeline/placement.h"

#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/listed.h"
#include "mapping/work_offset.h"
#include "pipeline/roles.h"
#include "toolpath/tip_motions.h"
#include "toolpath/trajectory.h"

namespace clsurf {
namespace {

/// For a program that sets its offsets itself. Some controllers record machine positions, others those of the work system:
/// the better fit to the path decides.
Eigen::Isometry3d own_or_none(const Program& program, const Log& log, const Eigen::Isometry3d& own,
                              Diagnostics& diagnostics) {
    const Eigen::Isometry3d none = Eigen::Isometry3d::Identity();
    for (const Role role : all_roles) {
        if (!log.has(role)) continue;
        const double with = share_on_path(reconstruct(log, role, own), program);
        const double without = share_on_path(reconstruct(log, role, none), program);
        if (!(without > with)) return own;
        diagnostics.add(
            {Severity::note, "map.coordinates", Place::of_file(log.name),
             fmt::format("positions are read as those of the work system, without the offset {} that {} sets",
                         pose_numbers(own), program.main().name()),
             fmt::format("--work-offset {} reads them as machine coordinates", pose_numbers(own))});
        return none;
    }
    return own;
}

}  // namespace

std::optional<Eigen::Isometry3d> pose_of(const Log& log) {
    if (!log.work_offset) return std::nullopt;
    return pose_of(*log.work_offset, log.work_rotation);
}

std::optional<Eigen::Isometry3d> zero_of(const FramePoses& given, const Log& log, Diagnostics& diagnostics) {
    const std::optional<Eigen::Isometry3d> recorded = pose_of(log);
    if (!given.zero || !recorded || !given.zero_is_default) return given.zero ? given.zero : recorded;
    if (!given.zero->isApprox(*recorded, 1e-9)) {
        diagnostics.add({Severity::note, "config.overruled", Place::of_file(log.name),
                         fmt::format("the log states work-offset {}: the default {} is not used",
                                     pose_numbers(*recorded), pose_numbers(*given.zero)),
                         "--work-offset on the command line takes precedence"});
    }
    return recorded;
}

Eigen::Isometry3d place_program(Program& program, const Log& log, FramePoses given, const Kinematics* kinematics,
                                Diagnostics& diagnostics) {
    given.zero = zero_of(given, log, diagnostics);
    given.tool_by_kinematics = kinematics != nullptr;
    given.starts_anywhere = true;
    const std::vector<int> unknown = unknown_systems(program.motions);
    if (unknown.size() > 1) {
        std::vector<std::string> names;
        bool missing = false;
        for (const int system : unknown) {
            names.push_back(name_of_work_system(system, program.dialect));
            missing = missing || (system != unknown.front() && !given.systems.contains(system));
        }
        if (missing) {
            diagnostics.add({Severity::note, "program.work-offset", Place::of_file(program.main().name()),
                             fmt::format("cuts in {}, and sets none of them: they are assumed to be equal to {}",
                                         listed(names), name_of_work_system(unknown.front(), program.dialect)),
                             "give one of them with --work-offset G55:X,Y,Z"});
        }
    }
    return place_motions(program, given);
}

Eigen::Isometry3d place_with(Program& program, const Log& log, const FramePoses& given, const Kinematics* kinematics,
                             Diagnostics& diagnostics) {
    const Eigen::Isometry3d pose = place_program(program, log, given, kinematics, diagnostics);
    if (given.zero || pose_of(log) || kinematics != nullptr || pose.matrix().isIdentity(0)) return pose;
    return own_or_none(program, log, pose, diagnostics);
}

Vec3 start_of(const Log& log, const Kinematics& kinematics, const Eigen::Isometry3d& pose) {
    const Role role = shown_role(log);
    if (log.records == 0 || !log.has(role)) return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    return pose.inverse() * (reconstruct(log, role, Vec3::Zero()).at(0) - kinematics.zero_position());
}

Eigen::Isometry3d place_tips_with(Program& program, const Log& log, const FramePoses& given,
                                  const Kinematics* kinematics, Diagnostics& diagnostics) {
    const Eigen::Isometry3d pose = place_with(program, log, given, kinematics, diagnostics);
    if (kinematics != nullptr) {
        solve_tool_axes(program, *kinematics, {}, {}, pose.linear());
        make_tip_motions(program, *kinematics, pose, start_of(log, *kinematics, pose));
    }
    return pose;
}

}  // namespace clsurf
