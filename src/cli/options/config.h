#pragma once
// .clsurf.toml: the second source of option values, after the command line. Code that reads options
// does not depend on it; its values are "defaulted" in Boost's terms (given() in cli/options/options.h).

#include <string>
#include <vector>

#include "cli/options/used_config.h"
#include "cli/subcommand.h"
#include "io/readers/config_entry.h"

namespace clsurf::cli {

/// The closest .clsurf.toml in or above the folder of the first file among the arguments, or of the working folder;
/// empty: none. O(depth of the folder).
[[nodiscard]] std::string find_config(const std::vector<std::string>& arguments, const po::variables_map& values);

/// Adds the options of the file that the command line does not set. File names in it are relative to its folder. Keys that
/// only other subcommands have are skipped. Throws InputError with the line: an unknown key, a value that the
/// option does not accept.
[[nodiscard]] UsedConfig store_config(const std::string& path, const po::options_description& options,
                                      po::variables_map& values);

/// An entry as words of a command line; file names are relative to `folder`. Throws InputError: a value for a flag,
/// no value for another option.
[[nodiscard]] po::option option_of(const io::ConfigEntry& entry, const po::option_description& description,
                                   const std::string& folder);

}  // namespace clsurf::cli
