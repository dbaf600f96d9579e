#pragma once
// .clsurf.toml: a second source of option values, after the command line. Nobody who reads options
// needs to know it; what comes from it is "defaulted" in Boost's words (given() in cli/options/options.h).

#include <string>
#include <vector>

#include "cli/options/used_config.h"
#include "cli/subcommand.h"
#include "io/readers/config_entry.h"

namespace clsurf::cli {

/// The nearest .clsurf.toml at or above the folder of the first file among the arguments, else of the working folder;
/// empty: none. O(depth of the folder).
[[nodiscard]] std::string find_config(const std::vector<std::string>& arguments, const po::variables_map& values);

/// Adds what the file says and the command line does not. File names in it are relative to its folder. Keys that only
/// other subcommands know are passed over. Throws InputError with the line: a key that none knows, a value that the
/// option does not take.
[[nodiscard]] UsedConfig store_config(const std::string& path, const po::options_description& options,
                                      po::variables_map& values);

/// An entry as the words of a command line; names of files are relative to `folder`. Throws InputError: a value for a flag,
/// none for another option.
[[nodiscard]] po::option option_of(const io::ConfigEntry& entry, const po::option_description& description,
                                   const std::string& folder);

}  // namespace clsurf::cli
