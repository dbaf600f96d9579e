#include "io/formats/map_piece.h"

#include <bit>
#include <cstdint>
#include <span>

#include <fmt/format.h>

#include "core/error.h"
#include "core/version.h"
#include "io/files/crc32c.h"
#include "io/files/json_value.h"
#include "io/formats/sealed_json.h"

namespace clsurf::io {
namespace {

constexpr const char* piece_hint = "clsurf render part.nc run.biip --survey run.survey --shard 1/8 -o piece1.piece";

std::uint32_t crc_of(std::string_view bytes) { return crc32c(std::as_bytes(std::span(bytes))); }

}  // namespace

std::string bytes_of(const MapPiece& piece, const SurveyOrigin& origin, const std::string& settings) {
    Json json;
    json["kind"] = "map piece";
    json["clsurf"] = version;
    json["shard"] = {piece.shard.number, piece.shard.count};
    json.update(json_of(origin));
    json["settings"] = settings;
    // Stored as bits, so that the merged map does not depend on the printing of numbers.
    json["range"] = {std::bit_cast<std::uint64_t>(piece.lowest), std::bit_cast<std::uint64_t>(piece.highest)};
    json["drawn_crc32c"] = crc_of(piece.drawn);
    return sealed_json(json).append(piece.drawn);
}

MapPiece read_map_piece(const std::string& path, const SurveyOrigin& origin, const std::string& settings) {
    const Source source = map_file(path);
    const auto fail = [&](const std::string& what) -> void {
        throw InputError(Place::of_file(path), what, piece_hint);
    };
    const std::string_view all = source.text();
    const std::size_t end = all.find('\n');
    const std::string_view head = all.substr(0, end == std::string_view::npos ? all.size() : end + 1);
    const Json json = parse_bounded(head);
    if (!json.is_object() || json.value("kind", "") != "map piece") fail("is not what clsurf render --shard writes");
    if (!is_sealed_json(head)) fail("is cut or damaged: the checksum of its head differs");
    MapPiece piece;
    try {
        if (json.at("clsurf").get<std::string>() != version) fail("is a piece of another version of clsurf");
        if (origin_of(json) != origin) fail("is a piece of another log or program, or was drawn with other options");
        if (const auto own = json.at("settings").get<std::string>(); own != settings)
            fail(fmt::format("was drawn with {}, not with {}", own, settings));
        piece.shard = {json.at("shard").at(0).get<int>(), json.at("shard").at(1).get<int>()};
        piece.lowest = std::bit_cast<double>(json.at("range").at(0).get<std::uint64_t>());
        piece.highest = std::bit_cast<double>(json.at("range").at(1).get<std::uint64_t>());
        piece.drawn = all.substr(head.size());
        if (crc_of(piece.drawn) != json.at("drawn_crc32c").get<std::uint32_t>())
            fail("is cut or damaged: the checksum of its pixels differs");
    } catch (const nlohmann::json::exception&) { fail("is cut or damaged"); }
    piece.keep_alive = source.keep_alive;
    return piece;
}

}  // namespace clsurf::io
