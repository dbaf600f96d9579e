#pragma once
// Help: the subcommands, the options of one, and the tables behind option values.

#include <string>
#include <vector>

#include "cli/subcommand.h"

namespace clsurf::cli {

/// All options of a subcommand, the common ones included.
[[nodiscard]] po::options_description visible_options(const Subcommand& subcommand);

/// Throws UsageError with a suggestion.
[[nodiscard]] const Subcommand& find_subcommand(const std::string& name);

void print_help(const Subcommand& subcommand);

/// `clsurf help [SUBCOMMAND | fields | formats | dialects | colormaps] [--json]`.
ExitCode help(const std::vector<std::string>& words);

}  // namespace clsurf::cli
