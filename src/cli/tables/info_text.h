#pragma once
// The output of `info` for programs and logs.

#include "log/log.h"
#include "pipeline/log_verdict.h"
#include "program/program.h"
#include "toolpath/toolpath_summary.h"

namespace clsurf::cli {

void print_program(const Program& program, const ToolpathSummary& summary, const Diagnostics& diagnostics);
void print_log(const Log& log, const LogVerdict& verdict, const Diagnostics& diagnostics);
/// Prints errors, which determine the exit code, to stderr as well.
void print_errors(const Diagnostics& diagnostics);

}  // namespace clsurf::cli
