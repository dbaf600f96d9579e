#include "cli/pictures/render_shards.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/options/survey_options.h"
#include "cli/pictures/map_content.h"
#include "cli/pictures/picture_output.h"
#include "cli/pictures/shard_map.h"
#include "core/file_name.h"
#include "io/files/atomic_file.h"
#include "io/formats/map_piece.h"

namespace clsurf::cli {
namespace {

void refuse_whole_log_options(const RenderOptions& options, const po::variables_map& values) {
    refuse_with_survey(
        values, {"defects", "before", "programmed", "mark-point", "mark-line", "points", "lines", "passes", "follow"});
    if (options.part.as_machined || options.part.role)
        throw UsageError("--surface cannot be combined with --survey: the map shows the positions that were surveyed");
    if (options.part.log.empty())
        throw UsageError("--survey needs the log that was surveyed: clsurf render part.nc run.biip …");
}

void refuse_unclear_shards(const po::variables_map& values) {
    const auto both = [&](const char* a, const char* b) {
        if (given(values, a) && given(values, b))
            throw UsageError(fmt::format("--{} cannot be combined with --{}", a, b));
    };
    both("shard", "shards");
    both("shard", "merge");
    both("shards", "merge");
    if (values.count("survey") == 0) refuse_without_survey(values, {"shard", "shards", "merge"});
}

/// The settings that all pieces must share besides the survey: the look of the map.
std::string settings_of_map(const po::variables_map& values) {
    po::options_description options;
    declare_render(options);
    return fmt::format("{}", fmt::join(words_of(options, values, {"output"}), " "));
}

ShardMap map_of_shards(const RenderOptions& options, const SurveyedLog& log, const po::variables_map& values,
                       StageClock& clock) {
    Shown shown;
    shown.part = load_surveyed_part(options.part, log.survey, clock);
    shown.surface = surveyed_surface(shown.part, log.survey);
    print(shown.part.diagnostics, values);
    return {options, std::move(shown), log.survey};
}

void write_piece(const RenderOptions& options, const ShardNumber& shard, const po::variables_map& values) {
    io::AtomicFile output(options.output);
    StageClock clock(read_common(values), 6);
    const SurveyedLog log = read_surveyed_log(options.part, values);
    ShardMap map = map_of_shards(options, log, values, clock);
    clock.begin("draw");
    const ShardMap::Drawn drawn = map.draw(shard.number, shard.number, shard.count);
    clock.begin("write the piece");
    const std::string bytes = drawn.parts.bytes();
    output.write(io::bytes_of({shard, drawn.lowest, drawn.highest, bytes}, log.origin, settings_of_map(values)));
    output.commit();
    clock.end();
}

struct NamedPiece {
    std::string path;
    io::MapPiece piece;
};

/// The pieces of all shards, in order. Throws UsageError: a piece is missing, duplicate, or of another division into shards.
std::vector<NamedPiece> read_pieces(const std::vector<std::string>& paths, const io::SurveyOrigin& origin,
                                    const std::string& settings) {
    std::vector<NamedPiece> pieces;
    for (const std::string& path : paths) {
        pieces.push_back({path, io::read_map_piece(path, origin, settings)});
        const int here = pieces.back().piece.shard.count, first = pieces.front().piece.shard.count;
        if (here != first)
            throw UsageError(fmt::format("{} is one of {} pieces, {} is one of {}", path, here, paths.front(), first));
    }
    const auto number_of = [](const NamedPiece& named) { return named.piece.shard.number; };
    std::ranges::stable_sort(pieces, {}, number_of);
    const int count = pieces.front().piece.shard.count;
    for (int number = 1; number <= count; ++number) {
        const auto found = std::ranges::count(pieces, number, number_of);
        if (found == 0) throw UsageError(fmt::format("piece {}/{} is missing", number, count));
        if (found > 1) throw UsageError(fmt::format("duplicate piece {}/{}", number, count));
    }
    return pieces;
}

/// Merges pieces with the samples of at most two in memory.
ShardMap::Drawn merged(const std::vector<NamedPiece>& pieces, const ShardMap& map) {
    std::optional<ShardMap::Drawn> all;
    for (const auto& [path, piece] : pieces) {
        std::optional<viz::DrawnParts> parts = viz::DrawnParts::read(piece.drawn, map.camera());
        if (!parts) throw InputError(Place::of_file(path), "is cut or damaged");
        ShardMap::Drawn drawn{std::move(*parts), piece.lowest, piece.highest};
        if (all)
            all->add(drawn);
        else
            all = std::move(drawn);
    }
    return std::move(*all);
}

}  // namespace

void declare_render_with_shards(po::options_description& options) {
    declare_render(options);
    declare_shard(options, "draw one of N parts of the log, cut at passes, and write it to -o FILE for --merge");
    // clang-format off
    options.add_options()
        ("merge", po::value<std::vector<std::string>>()->multitoken()->value_name("FILE…"), "the map from the pieces of all of its shards")
        ("shards", po::value<int>()->default_value(8)->value_name("N"), "with --survey alone: how many parts the log is cut into, which are drawn here one after the other, with the memory of one");
    // clang-format on
}

bool draw_in_shards(const RenderOptions& options, const po::variables_map& values) {
    refuse_unclear_shards(values);
    if (values.count("survey") == 0) return false;
    refuse_whole_log_options(options, values);
    if (const std::optional<ShardNumber> shard = read_shard_number(values)) {
        write_piece(options, *shard, values);
        return true;
    }
    RenderOptions wanted = options;
    PictureOutput output(wanted.output, "-o", PictureKind::drawing);
    wanted.shown.look.keep_drawing = output.wants_drawing();
    StageClock clock(read_common(values), 6);
    const SurveyedLog log = read_surveyed_log(wanted.part, values);
    ShardMap map = map_of_shards(wanted, log, values, clock);
    clock.begin("draw");
    const int shards = read_shard_count(values);
    const viz::Image image = map.picture(
        given(values, "merge")
            ? merged(read_pieces(values["merge"].as<std::vector<std::string>>(), log.origin, settings_of_map(values)),
                     map)
            : map.draw(1, shards, shards));
    clock.begin("write the picture");
    output.write(image, fmt::format("clsurf map of {} from {}: {} {:g} to {:g} {}", file_name(wanted.part.program),
                                    run_name(map.shown(), wanted), map.shown().field.info.name, map.range().low,
                                    map.range().high, map.shown().field.info.unit.name));
    clock.end();
    return true;
}

}  // namespace clsurf::cli
