#pragma once
// Starts other programs, and quotes words for the shell.

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace clsurf::cli {

/// A program with its arguments and limits.
struct ChildCommand {
    std::string file;                ///< file of the program
    std::vector<std::string> words;  ///< its name and its arguments
    std::string output;              ///< file for the program's output; the program has no input
    std::uint64_t memory = 0;        ///< [bytes] largest size of its data; 0: no limit
    bool own_group = false;  ///< own process group, so that the program can be killed together with its children
};

/// Starts the program. It is killed when this program ends; its exit code is 127 if the file cannot be run. `name`: a
/// description for the message. Throws SystemError: no process can be started.
[[nodiscard]] pid_t start_child(ChildCommand command, const std::string& name);

/// A word for a POSIX shell, in quotes.
[[nodiscard]] std::string quoted_for_shell(const std::string& word);

/// The same, in quotes only if necessary.
[[nodiscard]] std::string shell_word(const std::string& word);

}  // namespace clsurf::cli
