// clsurf SUBCOMMAND …: the table of subcommands, the exit codes, and the only catch.

#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "cli/help.h"
#include "cli/options.h"
#include "cli/subcommand.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/spelling.h"
#include "core/version.h"

namespace clsurf::cli {

std::span<const Subcommand> subcommands() {
    static const std::vector<Subcommand> table{
        render_subcommand(),
        query_subcommand(),
        info_subcommand(),
        moves_subcommand(),
        plot_subcommand(),
        export_subcommand(),
        convert_subcommand(),
        compare_subcommand(),

    };
    return table;
}

namespace {

ExitCode run(const Subcommand& subcommand, const std::vector<std::string>& words) {
    po::options_description all = visible_options(subcommand);
    po::options_description hidden;
    po::positional_options_description positions;
    for (const std::string& name : subcommand.positional) {
        const bool repeats = name.ends_with("…");
        const std::string key = repeats ? name.substr(0, name.size() - std::string("…").size()) : name;
        if (repeats) {
            hidden.add_options()(key.c_str(), po::value<std::vector<std::string>>());
        } else {
            hidden.add_options()(key.c_str(), po::value<std::string>());
        }
        positions.add(key.c_str(), repeats ? -1 : 1);
    }
    std::vector<std::string> known;
    for (const auto& option : all.options()) known.push_back(option->long_name());
    all.add(hidden);
    po::variables_map values;
    try {
        // Guessing from prefixes is off: a later option must not change what a script means.
        const int style = po::command_line_style::default_style & ~po::command_line_style::allow_guessing;
        po::store(po::command_line_parser(words).options(all).positional(positions).style(style).run(),
                  values);
        po::notify(values);
    } catch (const po::unknown_option& error) {
        std::string name = error.get_option_name();
        while (name.starts_with('-')) name.erase(0, 1);
        throw UsageError(error.what(),
                         did_you_mean(name, std::vector<std::string_view>(known.begin(), known.end())));
    } catch (const po::error& error) {
        throw UsageError(error.what());
    }
    if (values.count("help") > 0) {
        print_help(subcommand);
        return ExitCode::done;
    }
    set_thread_count(read_common(values).threads);
    return subcommand.run(values);
}

ExitCode run(std::vector<std::string> words) {
    if (words.empty()) {
        (void)help({});
        return ExitCode::usage;
    }
    const std::string first = words.front();
    words.erase(words.begin());
    if (first == "--help" || first == "-h" || first == "help") return help(words);
    if (first == "--version") {
        std::printf("clsurf %s\n", version);
        return ExitCode::done;
    }
    return run(find_subcommand(first), words);
}

}  // namespace
}  // namespace clsurf::cli

int main(int argc, char** argv) {
    using clsurf::ExitCode;
    ExitCode code = ExitCode::done;
    try {
        code = clsurf::cli::run(std::vector<std::string>(argv + 1, argv + argc));
        if (std::fflush(stdout) != 0) throw clsurf::SystemError("cannot write to standard output");
    } catch (const clsurf::UsageError& error) {
        std::fprintf(stderr, "clsurf: %s\n", error.what());
        if (!error.hint().empty()) std::fprintf(stderr, "    hint: %s\n", error.hint().c_str());
        code = ExitCode::usage;
    } catch (const clsurf::InputError& error) {
        std::fputs(error.what(), stderr);
        code = ExitCode::bad_input;
    } catch (const clsurf::SystemError& error) {
        std::fprintf(stderr, "clsurf: %s\n", error.what());
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
