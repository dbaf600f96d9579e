#pragma once
// From the words of a command line to values. Boost.Program_options cuts the words; what is wrong
// with them is said in our words, with the option's name and the nearest known one.

#include <string>
#include <vector>

#include "cli/subcommand.h"

namespace clsurf::cli {

/// A command line with its subcommand first: options may come before it. `words` must not be empty.
/// Throws UsageError where there is no subcommand.
[[nodiscard]] std::vector<std::string> subcommand_first(std::vector<std::string> words);

/// The values of the words after the subcommand's name, and of the configuration (cli/options/config.h). Throws InputError
/// of the latter, UsageError, and po::error where Boost cannot cut them; to_usage_error() says that in our words.
[[nodiscard]] po::variables_map parse_words(const Subcommand& subcommand, const std::vector<std::string>& given_words);

[[nodiscard]] UsageError to_usage_error(const po::error& error);

}  // namespace clsurf::cli
