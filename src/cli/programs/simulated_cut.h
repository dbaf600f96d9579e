#pragma once
// Runs the program of `profile` on a simulated machine before it is written.

#include "io/reports/cut_report.h"
#include "machine/machine.h"
#include "program/program.h"
#include "scan/scan_cut.h"

namespace clsurf::cli {

/// `program`: as read back. Adds a warning to it if the path is farther from the fit than the tolerances of program and
/// corners allow. Throws as simulate() does.
[[nodiscard]] io::SimulatedCut simulated_cut(Program& program, const ScanCut& cut, double tolerance,
                                             const Machine& machine);

}  // namespace clsurf::cli
