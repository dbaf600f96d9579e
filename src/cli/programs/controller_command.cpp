#include "cli/programs/controller_command.h"

#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "cli/child_process.h"
#include "core/error.h"

namespace clsurf::cli {
namespace {

constexpr double usual_timeout = 3600;               // s
constexpr std::uintmax_t most_output = 100'000'000;  // bytes of output of a command: protects the disk

void replace_all(std::string& text, std::string_view word, const std::string& by) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + by.size()))
        text.replace(at, word.size(), by);
}

/// Waits for the child, which writes its output to a file. Returns why it failed; empty: it ended with exit code 0.
std::string wait_for(pid_t child, const std::filesystem::path& output, double timeout) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout));
    int status = 0;
    while (::waitpid(child, &status, WNOHANG) == 0) {
        std::error_code none;
        const std::uintmax_t printed = std::filesystem::file_size(output, none);
        std::string reason;
        if (!none && printed > most_output)
            reason = fmt::format("it printed more than {} MB and was stopped", most_output / 1'000'000);
        else if (Clock::now() >= end)
            reason = fmt::format("it took longer than {} s and was stopped", timeout);
        if (!reason.empty()) {
            ::kill(-child, SIGKILL);
            ::waitpid(child, &status, 0);
            return reason;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    if (WIFSIGNALED(status)) return fmt::format("it was ended by signal {}", WTERMSIG(status));
    if (WEXITSTATUS(status) != 0) return fmt::format("it ended with exit code {}", WEXITSTATUS(status));
    return {};
}

/// The last line that is not empty.
std::string last_line(const std::filesystem::path& path) {
    constexpr std::streamoff most_read = 65536;
    std::ifstream file(path, std::ios::ate);
    file.seekg(std::max<std::streamoff>(0, static_cast<std::streamoff>(file.tellg()) - most_read));
    std::string last;
    for (std::string line; std::getline(file, line);) {
        if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
    }
    constexpr std::size_t most = 200;
    return last.size() > most ? last.substr(0, most) + "…" : last;
}

}  // namespace

void declare_controller(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("controller", po::value<std::string>()->value_name("COMMAND"), "command of the shell that runs the program {program} on your controller and writes the log {log}")
        ("timeout", po::value<double>()->value_name("S"), "longest time of one run of --controller (default: 3600)");
    // clang-format on
}

std::optional<ControllerCommand> read_controller(const po::variables_map& values) {
    if (values.count("controller") == 0) {
        if (values.count("timeout") > 0) throw UsageError("--timeout needs --controller");
        return std::nullopt;
    }
    const double timeout = values.count("timeout") > 0 ? values["timeout"].as<double>() : usual_timeout;
    if (!(timeout > 0) || !(timeout < 1e7)) throw UsageError("--timeout must be above 0 s");
    return ControllerCommand(values["controller"].as<std::string>(), timeout);
}

ControllerCommand::ControllerCommand(std::string words, double timeout) : words_(std::move(words)), timeout_(timeout) {
    for (const char* name : {"{program}", "{log}"}) {
        if (words_.find(name) == std::string::npos)
            throw UsageError(fmt::format("the --controller command lacks {}", name),
                             "for example: --controller 'run_on_kernel.sh {program} {log}'");
    }
}

std::string ControllerCommand::run(const std::filesystem::path& program, const std::filesystem::path& log) const {
    std::string command = words_;
    replace_all(command, "{program}", quoted_for_shell(program.string()));
    replace_all(command, "{log}", quoted_for_shell(log.string()));
    const std::filesystem::path output = log.string() + ".output";
    std::error_code none;
    std::filesystem::remove(log, none);
    const pid_t child =
        start_child({.file = "/bin/sh", .words = {"sh", "-c", command}, .output = output.string(), .own_group = true},
                    "the controller");
    std::string failure = wait_for(child, output, timeout_);
    const std::string printed = last_line(output);
    std::filesystem::remove(output, none);
    const std::string words = printed.empty() ? std::string() : fmt::format(" (\"{}\")", printed);
    if (failure.empty() && !std::filesystem::exists(log)) failure = "it ended with exit code 0 but wrote no log";
    // A pipe or a device may never end.
    if (failure.empty() && !std::filesystem::is_regular_file(log)) failure = "its log is not a file";
    if (!failure.empty()) return failure + words;
    return {};
}

RunFolder::RunFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "clsurf-runs-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
        throw SystemError(fmt::format("cannot make the folder {}: {}", name, std::strerror(errno)));
    path_ = name;
}

RunFolder::~RunFolder() {
    std::error_code none;
    std::filesystem::remove_all(path_, none);
}

}  // namespace clsurf::cli
