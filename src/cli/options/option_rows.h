#pragma once
// The options of a subcommand as rows, from which --help, man pages, completion and docs/reference are generated.

#include <string>
#include <string_view>
#include <vector>

#include "cli/subcommand.h"

namespace clsurf::cli {

/// The options in the help: those of the subcommand, and the common ones.
struct ShownOptions {
    po::options_description own;
    po::options_description common;
};
[[nodiscard]] ShownOptions shown_options(const Subcommand& subcommand);

struct OptionRow {
    std::string short_name;     ///< "-o"; empty: none
    std::string long_name;      ///< "--output"
    std::string value_name;     ///< "FILE"; empty: takes no value
    std::string default_value;  ///< empty: no default, or the description gives it
    std::string description;

    [[nodiscard]] std::string names() const;  ///< "-o, --output FILE"
    [[nodiscard]] std::string text() const;   ///< the description, and the default
};
[[nodiscard]] std::vector<OptionRow> rows_of(const po::options_description& options);

/// Whether values of that name are file names: "FILE", "OUT.png", "LOG".
[[nodiscard]] bool names_a_file(std::string_view value_name);

/// The options of a subcommand and the common ones.
[[nodiscard]] std::vector<OptionRow> all_rows(const Subcommand& subcommand);

}  // namespace clsurf::cli
