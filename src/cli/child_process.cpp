#include "cli/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include <fmt/format.h>

#include "core/error.h"

namespace clsurf::cli {
namespace {

[[noreturn]] void become(ChildCommand& command) {
    if (command.own_group) ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (command.memory > 0) {
        const rlimit limit{command.memory, command.memory};
        ::setrlimit(RLIMIT_DATA, &limit);
    }
    const int file = ::open(command.output.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
    const int nothing = ::open("/dev/null", O_RDONLY);
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(file, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
    std::vector<char*> arguments;
    for (std::string& word : command.words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    ::execv(command.file.c_str(), arguments.data());
    ::_exit(127);
}

}  // namespace

pid_t start_child(ChildCommand command, const std::string& name) {
    const pid_t child = ::fork();
    if (child < 0) throw SystemError(fmt::format("cannot start {}: {}", name, std::strerror(errno)));
    if (child == 0) become(command);
    return child;
}

std::string quoted_for_shell(const std::string& word) {
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

std::string shell_word(const std::string& word) {
    const bool plain =
        !word.empty() &&
        word.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./:=,+@%-") ==
            std::string::npos;
    return plain ? word : quoted_for_shell(word);
}

}  // namespace clsurf::cli
