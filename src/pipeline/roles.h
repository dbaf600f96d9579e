#pragma once
// Roles: which positions of a log are used for which purpose. Every subcommand chooses them here.

#include <array>
#include <optional>

#include "compare/run_difference.h"
#include "log/log.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// In the order of the signal flow.
inline constexpr std::array all_roles{Role::commanded, Role::feedback, Role::actual};

/// The displayed positions of a log: `wanted`, else the first available one of commanded, feedback, actual; actual if it
/// has none.
[[nodiscard]] Role shown_role(const Log& log, std::optional<Role> wanted = std::nullopt);

/// The positions by which lines are found: commanded if the log has them, else the displayed ones.
[[nodiscard]] Role mapping_role(const Log& log, Role shown);

/// The positions from which heights are measured while `path` is compared: `wanted`, else the first one of actual and
/// feedback that can be transformed into the workpiece like `path`. nullopt: the positions of `path` itself, because they are
/// not commanded or are the wanted ones.
[[nodiscard]] std::optional<Role> measured_role(const Log& log, const Trajectory& path,
                                                std::optional<Role> wanted = std::nullopt);

/// The positions by which two logs are compared: `wanted`, else the first one of commanded, feedback, actual that both
/// have; nullopt: none.
[[nodiscard]] std::optional<Role> common_role(const Log& a, const Log& b, std::optional<Role> wanted = std::nullopt);

/// Measured positions that both logs have: actual, else feedback; nullopt: none.
[[nodiscard]] std::optional<Role> common_measured_role(const Log& a, const Log& b);

/// The same as common_role(). Throws InputError: they have none in common.
[[nodiscard]] Role required_common_role(const Log& a, const Log& b, std::optional<Role> wanted = std::nullopt);

/// A run for the comparison with that of another log: aligned by `path`, with commanded and measured positions if both logs
/// have them. `log` must outlive the result.
[[nodiscard]] ComparedRun compared_run(const Log& log, const Log& other, Trajectory path);

}  // namespace clsurf
