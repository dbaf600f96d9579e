#pragma once
// `info` for a table that no log reader recognises: its columns, and a mapping file to start from.

#include <string>
#include <vector>

#include "cli/subcommand.h"
#include "io/files/mapped_file.h"

namespace clsurf::cli {

/// --suggest-mapping, --output.
void declare_suggestion(po::options_description& options);

/// Writes the mapping file of the one table; false: --suggest-mapping is not given. Throws UsageError: several
/// files, InputError: not a table.
[[nodiscard]] bool suggest_mapping_asked(const po::variables_map& values);

/// Describes a table as text, or appends it to the JSON `objects`. false: the file is not a table.
[[nodiscard]] bool describe_table(const io::Source& source, const po::variables_map& values,
                                  std::vector<std::string>& objects);

}  // namespace clsurf::cli
