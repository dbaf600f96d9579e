// clsurf SUBCOMMAND …: the table of subcommands, the exit codes, and the only catch.

#include <cstdio>
#include <exception>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include "cli/options.h"
#include "cli/subcommand.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/spelling.h"
#include "core/version.h"

namespace clsurf::cli {

std::span<const Subcommand> subcommands() {
    static const std::vector<Subcommand> table{
        moves_subcommand(),

    };
    return table;
}

namespace {

void print_help() {
    std::printf("clsurf %s: sees the mark before the cut\n\nusage: clsurf SUBCOMMAND …\n\n", version);
    for (const Subcommand& s : subcommands()) {
        std::printf("  %-10.*s %.*s\n", static_cast<int>(s.name.size()), s.name.data(),
                    static_cast<int>(s.summary.size()), s.summary.data());
    }
    std::printf("\n`clsurf SUBCOMMAND --help` shows the options of one.\n");
}

po::options_description visible_options(const Subcommand& subcommand) {
    po::options_description options("options", 100);
    subcommand.declare(options);
    po::options_description common("everywhere", 100);
    declare_common(common);
    options.add(common);
    return options;
}

void print_help(const Subcommand& subcommand) {
    std::string text = "usage: clsurf " + std::string(subcommand.name) + " " +
                       std::string(subcommand.arguments) + "\n\n" +
                       std::string(subcommand.description) + "\n\n";
    std::fputs(text.c_str(), stdout);
    std::ostringstream options;
    options << visible_options(subcommand);
    std::fputs(options.str().c_str(), stdout);
}

const Subcommand& find_subcommand(const std::string& name) {
    std::vector<std::string_view> names;
    for (const Subcommand& s : subcommands()) {
        if (s.name == name) return s;
        names.push_back(s.name);
    }
    throw UsageError("unknown subcommand '" + name + "'", did_you_mean(name, names));
}

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
        print_help();
        return ExitCode::usage;
    }
    const std::string first = words.front();
    words.erase(words.begin());
    if (first == "--help" || first == "-h" || (first == "help" && words.empty())) {
        print_help();
        return ExitCode::done;
    }
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
