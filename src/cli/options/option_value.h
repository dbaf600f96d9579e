#pragma once
// Checks values of options, with our own error messages instead of Boost's.

#include <string>

#include "cli/subcommand.h"

namespace clsurf::cli {

/// Checks the values of one option: whether numbers are numbers, and words are in the list. Throws UsageError.
void check_option(const po::option& option, const po::option_description& description);
/// Whether a text is a finite number, with or without a sign.
[[nodiscard]] bool is_a_number(const std::string& text);
/// Whether the option may be repeated.
[[nodiscard]] bool takes_a_list(const po::typed_value_base& type);

}  // namespace clsurf::cli
