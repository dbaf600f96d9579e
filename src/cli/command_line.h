#pragma once
// Converts the words of a command line to values. Boost.Program_options splits the words; error messages are
// our own, with the option's name and the most similar known one.

#include <string>
#include <vector>

#include "cli/subcommand.h"

namespace clsurf::cli {

/// The command line with its subcommand moved to the front: options may come before it. `words` must not be empty.
/// Throws UsageError if there is no subcommand.
[[nodiscard]] std::vector<std::string> subcommand_first(std::vector<std::string> words);

/// The values of the words after the subcommand's name, and of the configuration (cli/options/config.h). Throws InputError
/// about the configuration, UsageError, and po::error if Boost cannot split the words; to_usage_error() converts the latter.
[[nodiscard]] po::variables_map parse_words(const Subcommand& subcommand, const std::vector<std::string>& given_words);

[[nodiscard]] UsageError to_usage_error(const po::error& error);

}  // namespace clsurf::cli
