#pragma once
// Machine files (docs/formats/machine.md).

#include <string>
#include <vector>

#include "machine/limit_table.h"
#include "machine/machine.h"

namespace clsurf::io {

/// Reads and checks a machine file; keys that are not given keep their defaults. Throws InputError
/// with the line: unknown key or axis, wrong type, a limit that is not greater than 0, reversed travel.
[[nodiscard]] Machine read_machine(const std::string& path);
/// The same for the text of a machine file.
[[nodiscard]] Machine machine_of_text(const std::string& text, const std::string& name);

/// The limits that the file itself states: a missing key and a jerk of 0 limit nothing. First the
/// axes x, y, z, then rotary axes, the path, and the tolerance. Throws as read_machine().
[[nodiscard]] std::vector<StatedLimit> read_stated_limits(const std::string& path);

/// A machine file with every key.
[[nodiscard]] std::string machine_text(const Machine& machine);

}  // namespace clsurf::io
