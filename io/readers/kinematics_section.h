#pragma once
// The section [kinematics] of machine files (docs/formats/machine.md). Not installed.

#include <string>

#include "io/files/toml_table.h"
#include "machine/kinematics.h"

namespace clsurf::io {

/// Reads and judges the section. Throws InputError with the line: unknown type or key, axes that are
/// no pair, offsets that the type does not have.
[[nodiscard]] Kinematics read_kinematics(const TomlFile& file, const toml::table& table);

/// The section as a file has it.
[[nodiscard]] std::string kinematics_text(const Kinematics& kinematics);

}  // namespace clsurf::io
