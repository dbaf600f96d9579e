#include "pipeline/roles.h"

#include <string>
#include <utility>

#include "core/error.h"

namespace clsurf {
namespace {

/// In the order of preference: a scale measures closer to the tool than an encoder.
constexpr std::array measured_roles{Role::actual, Role::feedback};

}  // namespace

Role shown_role(const Log& log, std::optional<Role> wanted) {
    if (wanted) return *wanted;
    for (const Role role : all_roles) {
        if (log.has(role)) return role;
    }
    // No role is complete: chooses one that is partly present, so that an error names the missing axis.
    for (const Role role : all_roles) {
        for (const char* axis : {".x", ".y", ".z"}) {
            if (log.find(std::string(prefix_of(role)) + axis) != nullptr) return role;
        }
    }
    return Role::actual;
}

Role mapping_role(const Log& log, Role shown) { return log.has(Role::commanded) ? Role::commanded : shown; }

std::optional<Role> measured_role(const Log& log, const Trajectory& path, std::optional<Role> wanted) {
    if (path.role != Role::commanded || wanted == Role::commanded) return std::nullopt;
    if (wanted) return wanted;
    for (const Role role : measured_roles) {
        if (can_reconstruct_like(log, role, path)) return role;
    }
    return std::nullopt;
}

std::optional<Role> common_role(const Log& a, const Log& b, std::optional<Role> wanted) {
    if (wanted) return wanted;
    for (const Role role : all_roles) {
        if (a.has(role) && b.has(role)) return role;
    }
    return std::nullopt;
}

Role required_common_role(const Log& a, const Log& b, std::optional<Role> wanted) {
    if (const std::optional<Role> role = common_role(a, b, wanted)) return *role;
    throw InputError(Place::of_file(b.name),
                     "has no positions of a kind that " + a.name + " has too: commanded, feedback or actual");
}

ComparedRun compared_run(const Log& log, const Log& other, Trajectory path) {
    ComparedRun run;
    run.log = &log;
    run.path = std::move(path);
    if (log.has(Role::commanded) && other.has(Role::commanded))
        run.commanded = reconstruct_like(log, Role::commanded, run.path);
    if (const std::optional<Role> measured = common_measured_role(log, other)) {
        run.measured = reconstruct_like(log, *measured, run.path);
        if (*measured != run.path.role) run.truest = run.measured;
    }
    return run;
}

std::optional<Role> common_measured_role(const Log& a, const Log& b) {
    for (const Role role : measured_roles) {
        if (a.has(role) && b.has(role)) return role;
    }
    return std::nullopt;
}

}  // namespace clsurf
