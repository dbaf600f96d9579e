#pragma once
// The program that `profile` writes, run on a simulated machine before it appears.

#include "io/reports/cut_report.h"
#include "machine/machine.h"
#include "program/program.h"
#include "scan/scan_cut.h"

namespace clsurf::cli {

/// `program`: as it is read again. Adds a warning to it where the path is farther from the fit than the program and the corners
/// may be. Throws what simulate() throws.
[[nodiscard]] io::SimulatedCut simulated_cut(Program& program, const ScanCut& cut, double tolerance,
                                             const Machine& machine);

}  // namespace clsurf::cli
