#pragma once
// Sealed JSON: one line whose last key is the CRC-32C of all that stands before it. For files that only clsurf reads.

#include <string>
#include <string_view>

#include "io/files/json_value.h"
#include "io/formats/survey_file.h"

namespace clsurf::io {

/// An object that is not empty, with its seal and the end of the line.
[[nodiscard]] std::string sealed_json(const Json& object);
/// Whether a text is what sealed_json() made, byte for byte.
[[nodiscard]] bool is_sealed_json(std::string_view text);

/// The keys of an origin, and back. Throws Json::exception where one is missing.
[[nodiscard]] Json json_of(const SurveyOrigin& origin);
template <typename AnyJson>
[[nodiscard]] SurveyOrigin origin_of(const AnyJson& json) {
    const auto text = [&](const char* key) { return json.at(key).template get<std::string>(); };
    return {text("log"), text("program"), text("options")};
}

}  // namespace clsurf::io
