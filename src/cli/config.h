#pragma once
// .clsurf.toml: a second source of option values, after the command line. Nobody who reads options
// needs to know it; what comes from it is "defaulted" in Boost's words (given() in cli/options.h).

#include <map>
#include <string>
#include <string_view>

#include "cli/subcommand.h"
#include "core/place.h"
#include "io/readers/config_entry.h"

namespace clsurf::cli {

constexpr const char* config_name = ".clsurf.toml";

/// What was taken from a configuration.
struct UsedConfig {
    std::string path;                     ///< empty: there is none
    std::map<std::string, Place> places;  ///< of the keys that this subcommand took

    /// Where the value of an option stands that a message is about ("--tool: …"); nullptr: it is about none of these.
    [[nodiscard]] const Place* find(std::string_view message) const;
};

/// The nearest .clsurf.toml at or above the folder of the first file that the command line names, else of the
/// working folder; empty: none. O(depth of the folder).
[[nodiscard]] std::string find_config(const Subcommand& subcommand, const po::variables_map& values);

/// Adds what the file says and the command line does not. File names in it are relative to its folder. Keys that only
/// other subcommands know are passed over. Throws InputError with the line: a key that none knows, a value that the
/// option does not take.
[[nodiscard]] UsedConfig store_config(const std::string& path, const po::options_description& options,
                                      po::variables_map& values);

/// An entry as the words of a command line; names of files are relative to `folder`. Throws InputError: a value for a flag,
/// none for another option.
[[nodiscard]] po::option option_of(const io::ConfigEntry& entry, const po::option_description& description,
                                   const std::string& folder);

/// The configuration of this run, for messages.
[[nodiscard]] UsedConfig& used_config();

}  // namespace clsurf::cli
