#pragma once
// --controller: a command of the user that runs a program on a controller and writes its log.

#include <filesystem>
#include <optional>
#include <string>

#include "cli/options/options.h"

namespace clsurf::cli {

/// --controller, --timeout.
void declare_controller(po::options_description& options);

class ControllerCommand {
public:
    /// `words`: a shell command line with {program} and {log}. Throws UsageError: one of them is missing.
    ControllerCommand(std::string words, double timeout);

    /// Runs the command; both names are quoted for the shell. Returns how it failed, as a clause with the last line of its
    /// output; empty: it ended with exit code 0 in time and wrote the log. After the timeout it is killed with all processes
    /// that it started. Throws SystemError: nothing can be started.
    [[nodiscard]] std::string run(const std::filesystem::path& program, const std::filesystem::path& log) const;

private:
    std::string words_;
    double timeout_;  ///< [s]
};

/// The command of the options. Throws UsageError: --timeout without --controller, or not above 0.
[[nodiscard]] std::optional<ControllerCommand> read_controller(const po::variables_map& values);

/// A folder for the files of runs; the destructor removes it. Throws SystemError.
class RunFolder {
public:
    RunFolder();
    RunFolder(const RunFolder&) = delete;
    RunFolder& operator=(const RunFolder&) = delete;
    ~RunFolder();
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace clsurf::cli
