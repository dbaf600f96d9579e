#pragma once
// `info` on a table that no log reader knows: its columns, and a mapping file to start from.

#include <string>
#include <vector>

#include "cli/subcommand.h"
#include "io/files/mapped_file.h"

namespace clsurf::cli {

/// --suggest-mapping, --output.
void declare_suggestion(po::options_description& options);

/// Nothing where --suggest-mapping is not given. Writes the mapping file of the one table. Throws UsageError: several
/// files, InputError: no table.
[[nodiscard]] bool suggest_mapping_asked(const po::variables_map& values);

/// Says what a table holds, or appends it to the JSON `objects`. false: the file is no table.
[[nodiscard]] bool describe_table(const io::Source& source, const po::variables_map& values,
                                  std::vector<std::string>& objects);

}  // namespace clsurf::cli
