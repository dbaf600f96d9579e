#pragma once
// The records of a log that belong to a program, if the log names the program of each record: a line of a subprogram
// is not a line of the program that called it.

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/column.h"
#include "log/log.h"
#include "program/program.h"

namespace clsurf {

/// Lines of `program` per record: those of its own records; during its calls, the calling line; 0 before it begins.
/// nullptr: the channel `line` is used as it is, because the log names no programs or only one.
struct ProgramLines {
    std::shared_ptr<const Column<LineNumber>> lines;
    bool known = true;  ///< false: the log names several programs, but not this one (a diagnostic)
};

/// Names are compared without folders, endings and the prefixes of controls ("/_N_PART_MPF"). Adds `map.program` if
/// the program is not among those of the log.
[[nodiscard]] ProgramLines lines_of_program(const Log& log, const Program& program, Diagnostics& diagnostics);

/// A program's name without folder, ending and the prefixes of controls, in upper case: "/_N_WKS_DIR/_N_PART_MPF" and
/// "parts/part.mpf" → "PART".
[[nodiscard]] std::string plain_program_name(std::string_view path);

}  // namespace clsurf
