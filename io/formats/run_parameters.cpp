#include "io/formats/run_parameters.h"

#include "core/printable_text.h"
#include "io/files/compressed.h"
#include "io/files/json_value.h"

namespace clsurf::io {

std::string with_parameters(const std::string& metadata, const std::vector<RunParameter>& parameters) {
    Json json = parse_bounded(metadata);
    if (!json.is_object()) json = Json::object();
    if (!json.contains("parameters") || !json["parameters"].is_object()) json["parameters"] = Json::object();
    for (const RunParameter& parameter : parameters) json["parameters"][parameter.name] = parameter.value;
    return dump_compact(json);
}

std::vector<RunParameter> parameters_of_metadata(const std::string& metadata) {
    std::vector<RunParameter> parameters;
    if (metadata.empty()) return parameters;
    const Json json = parse_bounded(metadata);
    if (!json.is_object() || !json.contains("parameters") || !json["parameters"].is_object()) return parameters;
    for (const auto& [name, value] : json["parameters"].items()) {
        if (value.is_string())
            parameters.push_back({name, value.get<std::string>()});
        else if (value.is_number())
            parameters.push_back({name, value.dump()});
    }
    sort_parameters(parameters);
    return parameters;
}

std::vector<RunParameter> parameters_of_log(const std::string& path, const LogOptions& options) {
    const Source source = open_source(path);
    const LogFormat* format = recognise_log(source, options);
    if (format == nullptr || !format->names_parameters) return {};
    return parameters_of_metadata(format->open(source, options).metadata);
}

std::string list_of(const std::vector<RunParameter>& parameters) {
    std::string list;
    for (const RunParameter& parameter : parameters)
        list += (list.empty() ? "" : ", ") + printable(parameter.name) + "=" + printable(parameter.value);
    return list;
}

}  // namespace clsurf::io
