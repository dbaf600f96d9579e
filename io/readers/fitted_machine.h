#pragma once
// The machine that logs of a program show, for what simulates it again.

#include <string>
#include <vector>

#include "io/files/mapped_file.h"
#include "io/readers/program_file.h"
#include "log/log.h"
#include "machine/machine.h"
#include "program/frame_placement.h"
#include "repair/controller_repair.h"

namespace clsurf::io {

/// How the text of a program is read: as that of `source`, with the same name, dialect, options and subprograms.
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

/// Fits `known` to the logs (identify/identify.h). Where they do not allow it, returns `known`, with the warning
/// `optimize.machine` that says why.
[[nodiscard]] Machine fitted_machine(const TextReader& reader, const std::vector<ControllerLog>& logs,
                                     const Machine& known, Diagnostics& diagnostics);

}  // namespace clsurf::io
