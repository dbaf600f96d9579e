#include "io/formats/sealed_json.h"

#include <cstdint>
#include <span>

#include <fmt/format.h>

#include "io/files/crc32c.h"

namespace clsurf::io {
namespace {

constexpr std::string_view seal_key = R"(,"crc32c":")";
constexpr std::string_view seal_end = "\"}\n";

std::string with_seal(std::string text) {
    text.pop_back();  // }
    const std::uint32_t crc = crc32c(std::as_bytes(std::span(text)));
    return text + fmt::format("{}{:08x}{}", seal_key, crc, seal_end);
}

}  // namespace

std::string sealed_json(const Json& object) { return with_seal(dump_compact(object)); }

bool is_sealed_json(std::string_view text) {
    const std::size_t seal = text.rfind(seal_key);
    return seal != std::string_view::npos && with_seal(std::string(text.substr(0, seal)) + "}") == text;
}

Json json_of(const SurveyOrigin& origin) {
    return {{"log", origin.log_sha256}, {"program", origin.program_sha256}, {"options", origin.options}};
}

}  // namespace clsurf::io
