#pragma once
// A machine fitted to logs of a program, for its simulation.

#include <string>
#include <vector>

#include "io/files/mapped_file.h"
#include "io/readers/program_file.h"
#include "log/log.h"
#include "machine/machine.h"
#include "program/frame_placement.h"
#include "repair/controller_repair.h"

namespace clsurf::io {

/// Reads the text of a program like `source`: same name, dialect, options and subprograms.
struct TextReader {
    Source source;
    ProgramOptions options;
    std::string dialect;
    FramePoses poses;

    /// Motions as programmed, each in its own work system.
    [[nodiscard]] Program as_programmed(const std::string& text) const;
    /// Motions with axes along those of the machine.
    [[nodiscard]] Program level(const std::string& text) const;
};

/// Fits `known` to the logs (identify/identify.h). If they are not sufficient, returns `known` with the warning
/// `optimize.machine`, which says why.
[[nodiscard]] Machine fitted_machine(const TextReader& reader, const std::vector<ControllerLog>& logs,
                                     const Machine& known, Diagnostics& diagnostics);

}  // namespace clsurf::io
