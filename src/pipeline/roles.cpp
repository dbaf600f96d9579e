#include "pipeline/roles.h"

namespace clsurf {
namespace {

/// The most truthful first.
constexpr std::array measured_roles{Role::actual, Role::feedback};

}  // namespace

Role shown_role(const Log& log, std::optional<Role> wanted) {
    if (wanted) return *wanted;
    for (const Role role : all_roles) {
        if (log.has(role)) return role;
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

std::optional<Role> common_measured_role(const Log& a, const Log& b) {
    for (const Role role : measured_roles) {
        if (a.has(role) && b.has(role)) return role;
    }
    return std::nullopt;
}

}  // namespace clsurf
