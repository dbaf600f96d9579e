#pragma once
// Whether a text is a value that an option takes. What is wrong with it is said in our words, not in Boost's.

#include <string>

#include "cli/subcommand.h"

namespace clsurf::cli {

/// Checks the values of one option: numbers that are numbers, words that are in the list. Throws UsageError.
void check_option(const po::option& option, const po::option_description& description);
/// A finite number, with a sign or without.
[[nodiscard]] bool is_a_number(const std::string& text);
/// The option may be repeated.
[[nodiscard]] bool takes_a_list(const po::typed_value_base& type);

}  // namespace clsurf::cli
