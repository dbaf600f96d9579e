#pragma once
// Pieces of maps (.piece): what `clsurf render --shard` draws and `--merge` reads. They are made for one log by one version of
// clsurf: another version asks for other pieces.

#include <memory>
#include <string>
#include <string_view>

#include "io/formats/survey_file.h"
#include "pipeline/shards.h"

namespace clsurf::io {

struct MapPiece {
    ShardNumber shard;
    double lowest = 0, highest = 0;  ///< of the values that are shown; lowest > highest: there are none
    std::string_view drawn;          ///< bytes of what was drawn (viz/drawn_parts.h)
    std::shared_ptr<const void> keep_alive = nullptr;  ///< of a piece that was read: the mapped file of `drawn`
};

/// The bytes of the file: a line of JSON, and what was drawn. `settings`: what a piece depends on besides the survey.
[[nodiscard]] std::string bytes_of(const MapPiece& piece, const SurveyOrigin& origin, const std::string& settings);

/// Throws InputError: no piece, damaged, or of another log, program, version or other settings.
[[nodiscard]] MapPiece read_map_piece(const std::string& path, const SurveyOrigin& origin, const std::string& settings);

}  // namespace clsurf::io
