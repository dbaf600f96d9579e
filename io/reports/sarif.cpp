#include "io/reports/sarif.h"

#include <string_view>

#include <fmt/format.h>

#include "core/version.h"

namespace clsurf::io {

std::string sarif_uri(const std::string& path) {
    std::string uri;
    for (const char c : path) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') ||
                           (byte >= '0' && byte <= '9') || std::string_view("-._~/").find(c) != std::string_view::npos;
        uri += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
    }
    return path.starts_with('/') ? "file://" + uri : uri;
}

Json sarif_location(const std::string& uri, LineNumber first, LineNumber last, const std::string& message) {
    Json physical{{"artifactLocation", {{"uri", uri}}}};
    if (first > 0) physical["region"] = {{"startLine", first}, {"endLine", last}};
    Json json{{"physicalLocation", std::move(physical)}};
    if (!message.empty()) json["message"] = {{"text", message}};
    return json;
}

std::string sarif_text(Json rules, Json results, Json notifications, bool successful) {
    Json driver{{"name", "clsurf"}, {"version", version}, {"rules", std::move(rules)}};
    Json run{
        {"tool", {{"driver", std::move(driver)}}}, {"columnKind", "utf16CodeUnits"}, {"results", std::move(results)}};
    if (!notifications.empty())
        run["invocations"] = Json::array(
            {Json{{"executionSuccessful", successful}, {"toolExecutionNotifications", std::move(notifications)}}});
    return dump_foreign(Json{{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                             {"version", "2.1.0"},
                             {"runs", Json::array({std::move(run)})}});
}

}  // namespace clsurf::io
