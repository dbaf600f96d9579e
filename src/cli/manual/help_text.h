#pragma once
// The texts of --help and of `clsurf help`, and the parts that the manual shares.

#include <span>
#include <string>
#include <string_view>

#include "cli/subcommand.h"
#include "io/reports/listing_json.h"

namespace clsurf::cli {

/// "clsurf moves [options] PROGRAM"
[[nodiscard]] std::string usage_of(const Subcommand& subcommand);

/// The meaning of an exit code, for help and manual.
struct ExitCodeRow {
    ExitCode code;
    std::string_view meaning;
};
[[nodiscard]] std::span<const ExitCodeRow> exit_codes();

/// Names with descriptions and units, one row each.
[[nodiscard]] std::string listing_text(std::span<const io::ListingRow> rows);

inline constexpr std::string_view motto =
    "finds the NC program lines and controller behaviour that leave marks on finished surfaces";

/// `clsurf --help`
[[nodiscard]] std::string overview_text();
/// `clsurf SUBCOMMAND --help`
[[nodiscard]] std::string help_text(const Subcommand& subcommand);

}  // namespace clsurf::cli
