#pragma once
// The option tables as rows that --help, man pages, completion and docs/reference are written from.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/subcommand.h"
#include "io/reports/listing_json.h"

namespace clsurf::cli {

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
/// Those that are no tools of the build.
[[nodiscard]] std::vector<const Subcommand*> shown_subcommands();

/// "clsurf moves [options] PROGRAM"
[[nodiscard]] std::string usage_of(const Subcommand& subcommand);

/// What an exit code means, for help and manual.
struct ExitCodeRow {
    ExitCode code;
    std::string_view meaning;
};
[[nodiscard]] std::span<const ExitCodeRow> exit_codes();

/// Names beside what they mean, with units, a row each.
[[nodiscard]] std::string listing_text(std::span<const io::ListingRow> rows);

inline constexpr std::string_view motto =
    "finds the NC program lines and controller behaviour that leave marks on finished surfaces";

/// `clsurf --help`
[[nodiscard]] std::string overview_text();
/// `clsurf SUBCOMMAND --help`
[[nodiscard]] std::string help_text(const Subcommand& subcommand);

}  // namespace clsurf::cli
