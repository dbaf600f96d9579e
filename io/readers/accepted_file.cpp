#include "io/readers/accepted_file.h"

#include <set>

#include <fmt/format.h>

#include "core/error.h"
#include "io/files/json_value.h"
#include "io/files/mapped_file.h"
#include "predictor/severity.h"

namespace clsurf::io {
namespace {

constexpr int format_version = 1;

[[noreturn]] void reject(const std::string& path, const std::string& text) {
    throw InputError(Place::of_file(path), text, "save it from the page of `clsurf report`, or see docs/accepted.md");
}

/// An optional key. `is`: whether its value has the right type.
template <typename Value>
Value take(const Json& json, const char* key, bool (Json::*is)() const noexcept, const char* kind, Value usual,
           const std::string& path, const std::string& where) {
    const auto found = json.find(key);
    if (found == json.end()) return usual;
    if (!((*found).*is)()) reject(path, fmt::format("{}: '{}' must be {}", where, key, kind));
    return found->template get<Value>();
}

AcceptedDefect defect_of(const Json& json, std::size_t number, const std::string& path) {
    const std::string where = fmt::format("defect {} of the list", number);
    if (!json.is_object()) reject(path, where + " is not an object");
    AcceptedDefect defect;
    defect.fingerprint = take(json, "fingerprint", &Json::is_string, "a text", std::string(), path, where);
    if (defect.fingerprint.empty()) reject(path, where + " has no 'fingerprint'");
    defect.accepted = take(json, "accepted", &Json::is_boolean, "true or false", true, path, where);
    defect.severity = take(json, "severity", &Json::is_number_integer, "a whole number", 0, path, where);
    if (defect.severity < 0 || defect.severity > severities)
        reject(path, fmt::format("{}: 'severity' must be 1 … {}", where, severities));
    defect.comment = take(json, "comment", &Json::is_string, "a text", std::string(), path, where);
    defect.finding = take(json, "finding", &Json::is_string, "a text", std::string(), path, where);
    return defect;
}

}  // namespace

AcceptedFile read_accepted(const std::string& path) {
    const Source file = map_file(path);
    const Json json = parse_bounded(file.text());
    if (json.is_discarded()) reject(path, "is not valid JSON, or is too large");
    if (!json.is_object() || !json.contains("clsurf_accepted")) reject(path, "is not a file of accepted defects");
    if (json["clsurf_accepted"] != format_version)
        reject(path, fmt::format("'clsurf_accepted' is not {}: another version of this format", format_version));
    AcceptedFile accepted;
    accepted.name = path;
    accepted.program = take(json, "program", &Json::is_string, "a text", std::string(), path, "the file");
    if (!json.contains("defects") || !json["defects"].is_array()) reject(path, "has no list 'defects'");
    std::set<std::string> seen;
    for (const Json& entry : json["defects"]) {
        accepted.defects.push_back(defect_of(entry, accepted.defects.size() + 1, path));
        if (!seen.insert(accepted.defects.back().fingerprint).second)
            reject(path, fmt::format("fingerprint '{}' appears twice", accepted.defects.back().fingerprint));
    }
    return accepted;
}

}  // namespace clsurf::io
