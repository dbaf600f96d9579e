#pragma once
// Subcommand: one row of the table in subcommands.cpp. Help, man pages and completion are generated from it.
//
// The name of an option's value defines the allowed values: "auto|always|never" lists all words
// (others are refused before run() is called), "iso|top|AZ,EL" some of them, "DIALECT" means those of
// a vocabulary (cli/options/vocabulary.h), "FILE" and "FOLDER" are names that the shell can complete.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <boost/program_options.hpp>

#include "core/error.h"

namespace clsurf::cli {

namespace po = boost::program_options;

struct Subcommand {
    std::string_view name;
    std::string_view arguments;    ///< positional ones for the usage line, "PROGRAM LOG"
    std::string_view summary;      ///< one line, lower case, no full stop
    std::string_view description;  ///< paragraphs for --help and the man page; lines that begin
                                   ///< with a space are kept as they are, all others are filled
    /// Declares the options in the help; common options (help, threads, …) are added by main().
    void (*declare)(po::options_description& options);
    /// Names of the positional arguments in order; the last may repeat ("FILE…").
    std::vector<std::string> positional;
    ExitCode (*run)(const po::variables_map& values);
    bool hidden = false;  ///< not in the overview: a tool for the build
};

/// All subcommands, in the order of the help text.
[[nodiscard]] std::span<const Subcommand> subcommands();
/// The subcommands that are not hidden.
[[nodiscard]] std::vector<const Subcommand*> shown_subcommands();

/// The subcommand of that name. Throws UsageError with the most similar one.
[[nodiscard]] const Subcommand& find_subcommand(std::string_view name);

// One function per subcommand, each in the file of its name in subcommands/.
[[nodiscard]] Subcommand align_subcommand();
[[nodiscard]] Subcommand check_subcommand();
[[nodiscard]] Subcommand compare_subcommand();
[[nodiscard]] Subcommand convert_subcommand();
[[nodiscard]] Subcommand diff_subcommand();
[[nodiscard]] Subcommand export_subcommand();
[[nodiscard]] Subcommand fleet_subcommand();
[[nodiscard]] Subcommand history_subcommand();
[[nodiscard]] Subcommand identify_subcommand();
[[nodiscard]] Subcommand info_subcommand();
[[nodiscard]] Subcommand intervals_subcommand();
[[nodiscard]] Subcommand lint_subcommand();
[[nodiscard]] Subcommand machine_subcommand();
[[nodiscard]] Subcommand moves_subcommand();
[[nodiscard]] Subcommand optimize_subcommand();
[[nodiscard]] Subcommand plot_subcommand();
[[nodiscard]] Subcommand profile_subcommand();
[[nodiscard]] Subcommand query_subcommand();
[[nodiscard]] Subcommand record_subcommand();
[[nodiscard]] Subcommand render_subcommand();
[[nodiscard]] Subcommand report_subcommand();
[[nodiscard]] Subcommand simulate_subcommand();
[[nodiscard]] Subcommand survey_subcommand();
[[nodiscard]] Subcommand help_subcommand();
[[nodiscard]] Subcommand manual_subcommand();

}  // namespace clsurf::cli
