#pragma once
// Roles: which of a log's positions are used for what. Every subcommand chooses them here.

#include <array>
#include <optional>

#include "compare/run_difference.h"
#include "log/log.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// From what was wanted to what was done.
inline constexpr std::array all_roles{Role::commanded, Role::feedback, Role::actual};

/// The positions that a log is shown by: `wanted`, else commanded, feedback, actual, the first that it has; actual
/// where it has none.
[[nodiscard]] Role shown_role(const Log& log, std::optional<Role> wanted = std::nullopt);

/// The positions that lines are found by: commanded, where the log has them, else those that are shown.
[[nodiscard]] Role mapping_role(const Log& log, Role shown);

/// The positions that heights are measured from while `path` is compared: `wanted`, else actual, feedback, the first
/// that can be brought into the workpiece as `path` was; nullopt: those of `path` itself, which is not the commanded one
/// or is wanted.
[[nodiscard]] std::optional<Role> measured_role(const Log& log, const Trajectory& path,
                                                std::optional<Role> wanted = std::nullopt);

/// The positions that two logs are compared by: `wanted`, else commanded, feedback, actual, the first that both have;
/// nullopt: none.
[[nodiscard]] std::optional<Role> common_role(const Log& a, const Log& b, std::optional<Role> wanted = std::nullopt);

/// Measured positions that both logs have: actual, else feedback; nullopt: none.
[[nodiscard]] std::optional<Role> common_measured_role(const Log& a, const Log& b);

/// The same as common_role(). Throws InputError: they have none in common.
[[nodiscard]] Role required_common_role(const Log& a, const Log& b, std::optional<Role> wanted = std::nullopt);

/// A run as it is compared with that of another log: aligned by `path`, with commanded and measured positions where both
/// logs have them. `log` must outlive it.
[[nodiscard]] ComparedRun compared_run(const Log& log, const Log& other, Trajectory path);

}  // namespace clsurf
