#pragma once
// Subcommand: one row of the table in main.cpp. Help, man pages and completion are made from it.

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
    std::string_view summary;      ///< one line
    std::string_view description;  ///< paragraphs for --help and the man page; examples among them
    /// Declares what is shown in the help; common options (help, threads, …) are added by main().
    void (*declare)(po::options_description& options);
    /// Names of the positional arguments in order; the last may repeat ("file…").
    std::vector<std::string> positional;
    ExitCode (*run)(const po::variables_map& values);
};

/// All subcommands, in the order of the help text.
[[nodiscard]] std::span<const Subcommand> subcommands();

// One function a subcommand, each in the file of its name.
[[nodiscard]] Subcommand compare_subcommand();
[[nodiscard]] Subcommand convert_subcommand();
[[nodiscard]] Subcommand export_subcommand();
[[nodiscard]] Subcommand info_subcommand();
[[nodiscard]] Subcommand moves_subcommand();
[[nodiscard]] Subcommand plot_subcommand();
[[nodiscard]] Subcommand query_subcommand();
[[nodiscard]] Subcommand render_subcommand();

}  // namespace clsurf::cli
