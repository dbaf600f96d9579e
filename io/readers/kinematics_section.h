#pragma once
// The section [kinematics] of machine files (docs/formats/machine.md). Not installed.

#include <string>

#include "io/files/toml_table.h"
#include "machine/kinematics.h"

namespace clsurf::io {

/// Reads and checks the section. Throws InputError with the line: unknown type or key, axes that are
/// not a pair, offsets that the type does not have.
[[nodiscard]] Kinematics read_kinematics(const TomlFile& file, const toml::table& table);

/// The section as text of a machine file.
[[nodiscard]] std::string kinematics_text(const Kinematics& kinematics);

}  // namespace clsurf::io
