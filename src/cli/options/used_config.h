#pragma once
// The configuration file of this run, and what was taken from it: messages name its lines.

#include <map>
#include <string>
#include <string_view>

#include "core/place.h"

namespace clsurf::cli {

constexpr const char* config_name = ".clsurf.toml";

/// What was taken from a configuration.
struct UsedConfig {
    std::string path;                     ///< empty: there is none
    std::map<std::string, Place> places;  ///< of the keys that this subcommand took

    /// Where the value of an option stands that a message is about ("--tool: …"); nullptr: it is about none of these.
    [[nodiscard]] const Place* find(std::string_view message) const;
};

/// The configuration of this run, for messages.
[[nodiscard]] UsedConfig& used_config();

}  // namespace clsurf::cli
