#pragma once
// The options of a subcommand as rows: --help, man pages, completion and docs/reference are written from them.

#include <string>
#include <string_view>
#include <vector>

#include "cli/subcommand.h"

namespace clsurf::cli {

/// The options as the help shows them: those of the subcommand, and those that all have.
struct ShownOptions {
    po::options_description own;
    po::options_description common;
};
[[nodiscard]] ShownOptions shown_options(const Subcommand& subcommand);

struct OptionRow {
    std::string short_name;     ///< "-o"; empty: none
    std::string long_name;      ///< "--output"
    std::string value_name;     ///< "FILE"; empty: takes no value
    std::string default_value;  ///< empty: none, or said in the description
    std::string description;

    [[nodiscard]] std::string names() const;  ///< "-o, --output FILE"
    [[nodiscard]] std::string text() const;   ///< the description, and the default
};
[[nodiscard]] std::vector<OptionRow> rows_of(const po::options_description& options);

/// A value of that name is a file's name: "FILE", "OUT.png", "LOG".
[[nodiscard]] bool names_a_file(std::string_view value_name);

/// Those of a subcommand and those that all have.
[[nodiscard]] std::vector<OptionRow> all_rows(const Subcommand& subcommand);

}  // namespace clsurf::cli
