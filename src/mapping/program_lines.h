#pragma once
// Which records of a log belong to a program, where the log names the program of each record: a line
// of a subprogram is no line of the program that called it.

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/column.h"
#include "log/log.h"
#include "program/program.h"

namespace clsurf {

/// Lines of `program` per record: those of its own records; while what it called runs, the line that
/// called; 0 before it begins. nullptr: the channel `line` holds as it is, because the log names no
/// programs or only one.
struct ProgramLines {
    std::shared_ptr<const Column<LineNumber>> lines;
    bool known = true;  ///< false: the log names several programs, and none is called so (a diagnostic)
};

/// Names are compared without folders, endings and what controls put around them ("/_N_PART_MPF").
/// Adds `map.program` where the program is not among those of the log.
[[nodiscard]] ProgramLines lines_of_program(const Log& log, const Program& program, Diagnostics& diagnostics);

/// What is left of a program's name without folders, endings and what controls put around it, in upper case:
/// "/_N_WKS_DIR/_N_PART_MPF" and "parts/part.mpf" → "PART".
[[nodiscard]] std::string plain_program_name(std::string_view path);

}  // namespace clsurf
