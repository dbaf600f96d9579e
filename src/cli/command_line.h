#pragma once
// From the words of a command line to values. Boost.Program_options cuts the words; what is wrong
// with them is said in our words, with the option's name and the nearest known one.

#include <string>
#include <vector>

#include "cli/subcommand.h"

namespace clsurf::cli {

/// The options as the help shows them: those of the subcommand, and those that all have.
struct ShownOptions {
    po::options_description own;
    po::options_description common;
};
[[nodiscard]] ShownOptions shown_options(const Subcommand& subcommand);

/// The values of the words after the subcommand's name. Throws UsageError, and po::error where
/// Boost cannot cut them; to_usage_error() says that in our words.
[[nodiscard]] po::variables_map parse_words(const Subcommand& subcommand, const std::vector<std::string>& words);

[[nodiscard]] UsageError to_usage_error(const po::error& error);

}  // namespace clsurf::cli
