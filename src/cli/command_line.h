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

/// A command line with its subcommand first: options may come before it. `words` must not be empty.
/// Throws UsageError where there is no subcommand.
[[nodiscard]] std::vector<std::string> subcommand_first(std::vector<std::string> words);

/// The values of the words after the subcommand's name, and of the configuration (cli/config.h). Throws InputError of
/// the latter, UsageError, and po::error where
/// Boost cannot cut them; to_usage_error() says that in our words.
[[nodiscard]] po::variables_map parse_words(const Subcommand& subcommand, const std::vector<std::string>& given_words);

/// Checks the values of one option: numbers that are numbers, words that are in the list. Throws UsageError.
void check_option(const po::option& option, const po::option_description& description);
/// A finite number, with a sign or without.
[[nodiscard]] bool is_a_number(const std::string& text);
/// The option may be repeated.
[[nodiscard]] bool takes_a_list(const po::typed_value_base& type);
/// The words that are not options, in order.
[[nodiscard]] std::vector<std::string> argument_values(const Subcommand& subcommand, const po::variables_map& values);

[[nodiscard]] UsageError to_usage_error(const po::error& error);

}  // namespace clsurf::cli
