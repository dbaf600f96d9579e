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

std::string machine_of_metadata(const std::string& metadata) {
    const Json json = parse_bounded(metadata);
    if (!json.is_object()) return {};
    const auto text_of = [](const Json& object) {
        const auto machine = object.find("machine");
        return machine != object.end() && machine->is_string() ? machine->get<std::string>() : std::string();
    };
    const std::string machine = text_of(json);
    const auto simulation = json.find("simulation");
    return machine.empty() && simulation != json.end() && simulation->is_object() ? text_of(*simulation) : machine;
}

}  // namespace clsurf::io
