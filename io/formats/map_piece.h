#pragma once
// Pieces of maps (.piece): `clsurf render --shard` draws them and `--merge` reads them. A piece is valid for one log and one
// version of clsurf.

#include <memory>
#include <string>
#include <string_view>

#include "io/formats/survey_file.h"
#include "pipeline/shards.h"

namespace clsurf::io {

struct MapPiece {
    ShardNumber shard;
    double lowest = 0, highest = 0;  ///< range of the shown values; lowest > highest: no values
    std::string_view drawn;          ///< bytes of the drawn parts (viz/drawn_parts.h)
    std::shared_ptr<const void> keep_alive =
        nullptr;  ///< for a piece from a file: the mapped file that contains `drawn`
};

/// The bytes of the file: a line of JSON, and the drawn parts. `settings`: what a piece depends on besides the survey.
[[nodiscard]] std::string bytes_of(const MapPiece& piece, const SurveyOrigin& origin, const std::string& settings);

/// Throws InputError: not a piece, damaged, or made for another log, program, version or other settings.
[[nodiscard]] MapPiece read_map_piece(const std::string& path, const SurveyOrigin& origin, const std::string& settings);

}  // namespace clsurf::io
