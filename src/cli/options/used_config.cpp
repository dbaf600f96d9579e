#include "cli/options/used_config.h"

namespace clsurf::cli {

const Place* UsedConfig::find(std::string_view message) const {
    if (!message.starts_with("--")) return nullptr;
    const auto at = places.find(std::string(message.substr(2, message.find_first_of(": ") - 2)));
    return at == places.end() ? nullptr : &at->second;
}

UsedConfig& used_config() {
    static UsedConfig config;
    return config;
}

}  // namespace clsurf::cli
