#pragma once
// The configuration file of this run, and the values taken from it: messages refer to its lines.

#include <map>
#include <string>
#include <string_view>

#include "core/place.h"

namespace clsurf::cli {

constexpr const char* config_name = ".clsurf.toml";

/// The values taken from a configuration.
struct UsedConfig {
    std::string path;                     ///< empty: there is none
    std::map<std::string, Place> places;  ///< places of the keys that this subcommand used

    /// The place of the option that a message is about ("--tool: …"); nullptr: it is about another option.
    [[nodiscard]] const Place* find(std::string_view message) const;
};

/// The configuration of this run, for messages.
[[nodiscard]] UsedConfig& used_config();

}  // namespace clsurf::cli
