#pragma once
// The options of `report`.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/measured_options.h"
#include "cli/options/part.h"
#include "cli/runs/merged_shards.h"
#include "io/readers/accepted_file.h"

namespace clsurf::cli {

struct ReportOptions {
    PartOptions part;
    std::optional<Role> measured;
    std::string before, output, gl;
    std::optional<Measurement> measurement;  ///< measurement of the part, if there is one
    std::optional<io::AcceptedFile> accepted;
    std::vector<std::string> fields;  ///< empty: the default ones
    std::string first_field;
    std::uint64_t most_bytes = 0;
    std::vector<std::string> reading_options;
    std::optional<MergedShards> merged;  ///< findings of a log judged in shards
    int shards = 0;                      ///< number of shards for drawing the map; 0: undivided
};

void declare_report(po::options_description& options);
/// Throws UsageError.
[[nodiscard]] ReportOptions read_report_options(const po::variables_map& values);

}  // namespace clsurf::cli
