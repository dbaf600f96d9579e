#pragma once
// Sealed JSON: one line whose last key is the CRC-32C of everything before it. For files that only clsurf reads.

#include <string>
#include <string_view>

#include "io/files/json_value.h"
#include "io/formats/survey_file.h"

namespace clsurf::io {

/// A non-empty object with its seal and a line end.
[[nodiscard]] std::string sealed_json(const Json& object);
/// Whether a text is an unchanged result of sealed_json().
[[nodiscard]] bool is_sealed_json(std::string_view text);

/// An origin as JSON, and back. Throws Json::exception if a key is missing.
[[nodiscard]] Json json_of(const SurveyOrigin& origin);
template <typename AnyJson>
[[nodiscard]] SurveyOrigin origin_of(const AnyJson& json) {
    const auto text = [&](const char* key) { return json.at(key).template get<std::string>(); };
    return {text("log"), text("program"), text("options")};
}

}  // namespace clsurf::io
