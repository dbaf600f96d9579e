#pragma once
// Runs new programs on the user's controller and reads their logs.

#include <string>

#include "cli/programs/controller_command.h"
#include "io/readers/fitted_machine.h"
#include "repair/controller_repair.h"

namespace clsurf::cli {

class ControllerRuns {
public:
    /// `reader` determines how the text of a program is read, and must outlive the object.
    ControllerRuns(ControllerCommand command, const io::TextReader& reader);

    /// Writes the text to a file with the name of the program, runs the command, reads the log and checks that it belongs
    /// to the text. Throws SystemError: the file cannot be written, or nothing can be started.
    [[nodiscard]] ControllerOutcome run(const std::string& text) const;

private:
    ControllerCommand command_;
    const io::TextReader& reader_;
    RunFolder folder_;
};

/// `simulate --controller`: runs a program file on the controller instead of a simulated one, and keeps its log. Throws
/// UsageError: options of the simulation; InputError: the run failed, or its log is not of this program. Warns of a log that
/// lacks motions of the program.
ExitCode record_on_controller(const ControllerCommand& command, const std::string& program, const std::string& output,
                              const po::variables_map& values);

}  // namespace clsurf::cli
