#include "io/readers/log_tool.h"

#include "io/files/json_value.h"

namespace clsurf::io {

std::string tool_of_metadata(const std::string& metadata) {
    if (metadata.empty()) return {};
    const Json json = parse_bounded(metadata);
    if (!json.is_object()) return {};
    const auto tool = json.find("tool");
    return tool != json.end() && tool->is_string() ? tool->get<std::string>() : std::string();
}

}  // namespace clsurf::io
