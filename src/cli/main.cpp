// clsurf SUBCOMMAND …: runs one subcommand and converts exceptions to exit codes, in the only catch for all
// errors.

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/manual/help_text.h"
#include "cli/options/options.h"
#include "cli/options/used_config.h"
#include "cli/subcommand.h"
#include "cli/terminal.h"
#include "cli/version_text.h"
#include "core/error.h"
#include "core/parallel.h"
#include "io/files/mapped_file.h"
#include "io/files/overwrite_guard.h"

namespace clsurf::cli {

namespace {

/// Prints which configuration is used, and for which options.
void say_config() {
    const UsedConfig& config = used_config();
    if (config.path.empty()) return;
    std::string keys;
    for (const auto& [key, where] : config.places) keys += (keys.empty() ? "" : ", ") + key;
    std::fprintf(stderr, "options from %s: %s\n", config.path.c_str(),
                 keys.empty() ? "none applies to this subcommand" : keys.c_str());
}

ExitCode run(const Subcommand& subcommand, const std::vector<std::string>& words) {
    const po::variables_map values = parse_words(subcommand, words);
    if (values.count("help") > 0) {
        write_to_stdout(help_text(subcommand));
        return ExitCode::done;
    }
    const CommonOptions common = read_common(values);
    if (common.verbose) say_config();
    set_thread_count(common.threads);
    return subcommand.run(values);
}

ExitCode run(const std::vector<std::string>& words) {
    if (words.empty()) {
        std::fputs(overview_text().c_str(), stderr);
        return ExitCode::usage;
    }
    const std::string& first = words.front();
    const bool alone = words.size() == 1;
    if (alone && (first == "--help" || first == "-h")) {
        write_to_stdout(overview_text());
        return ExitCode::done;
    }
    if (first == "--version" || first == "version") {
        write_to_stdout(version_text());
        return ExitCode::done;
    }
    const std::vector<std::string> ordered = subcommand_first(words);
    return run(find_subcommand(ordered.front()), {ordered.begin() + 1, ordered.end()});
}

ExitCode report(const UsageError& error) {
    // A wrong value in the configuration is reported with its line.
    if (const Place* where = used_config().find(error.what())) {
        write_message(InputError(*where, error.what(), error.hint()).what());
        return ExitCode::bad_input;
    }
    write_message("clsurf: error: " + std::string(error.what()) + "\n");
    if (!error.hint().empty()) write_message("    hint: " + error.hint() + "\n");
    if (!used_config().places.empty()) say_config();
    return ExitCode::usage;
}

}  // namespace
}  // namespace clsurf::cli

int main(int argc, char** argv) {
    using clsurf::ExitCode;
    ExitCode code = ExitCode::done;
    clsurf::io::guard_mapped_files();
    clsurf::io::guard_inputs();
    std::signal(SIGXFSZ, SIG_IGN);  // reaching a limit on file sizes becomes an error of write(), as for a full disk
    try {
        code = clsurf::cli::run(std::vector<std::string>(argv + 1, argv + argc));
        clsurf::io::check_mapped_files();
        if (std::fflush(stdout) != 0) {
            throw clsurf::SystemError(std::string("cannot write to standard output: ") + std::strerror(errno));
        }
    } catch (const clsurf::UsageError& error) {
        code = clsurf::cli::report(error);
    } catch (const boost::program_options::error& error) {
        code = clsurf::cli::report(clsurf::cli::to_usage_error(error));
    } catch (const clsurf::InputError& error) {
        clsurf::cli::write_message(error.what());
        code = ExitCode::bad_input;
    } catch (const clsurf::SystemError& error) {
        clsurf::cli::write_message("clsurf: error: " + std::string(error.what()) + "\n");
        code = ExitCode::system;
    } catch (const std::bad_alloc&) {
        std::fputs("clsurf: out of memory\n", stderr);
        code = ExitCode::system;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "clsurf: internal error: %s\n", error.what());
        code = ExitCode::system;
    }
    return static_cast<int>(code);
}
