#pragma once
// What `info` prints of programs and logs.

#include "log/log.h"
#include "pipeline/log_verdict.h"
#include "program/program.h"
#include "toolpath/toolpath_summary.h"

namespace clsurf::cli {

void print_program(const Program& program, const ToolpathSummary& summary, const Diagnostics& diagnostics);
void print_log(const Log& log, const LogVerdict& verdict, const Diagnostics& diagnostics);
/// Errors decide the exit code, so they are messages on stderr as well.
void print_errors(const Diagnostics& diagnostics);

}  // namespace clsurf::cli
