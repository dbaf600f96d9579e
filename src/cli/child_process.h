#pragma once
// Programs that clsurf starts, and words for the shell.

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace clsurf::cli {

/// A program and how it is run.
struct ChildCommand {
    std::string file;                ///< of the program
    std::vector<std::string> words;  ///< its name and its arguments
    std::string output;              ///< what it prints is written to this file; it reads nothing
    std::uint64_t memory = 0;        ///< [bytes] of its data; 0: no limit
    bool own_group = false;          ///< so that it can be killed with all that it starts
};

/// Starts it; the child is gone with this program, and ends with exit code 127 when the file cannot be run. `name`: what it
/// is, for the message. Throws SystemError: no process can be started.
[[nodiscard]] pid_t start_child(ChildCommand command, const std::string& name);

/// One word for a POSIX shell, in quotes.
[[nodiscard]] std::string quoted_for_shell(const std::string& word);

/// The same, in quotes only where it needs them.
[[nodiscard]] std::string shell_word(const std::string& word);

}  // namespace clsurf::cli
