#include "cli/options/survey_options.h"

#include <charconv>

#include <fmt/format.h>

#include "io/files/compressed.h"
#include "io/formats/program_identity.h"
#include "io/readers/part_file.h"

namespace clsurf::cli {
namespace {

constexpr int most_shards = 1'000'000;

}  // namespace

void declare_shard(po::options_description& options, const char* what) {
    // clang-format off
    options.add_options()
        ("survey", po::value<std::string>()->value_name("FILE"), "the survey of the log (`clsurf survey`), for shards")
        ("shard", po::value<std::string>()->value_name("I/N"), what);
    // clang-format on
}

void refuse_without_survey(const po::variables_map& values, std::initializer_list<const char*> names) {
    for (const char* name : names) {
        if (given(values, name)) throw UsageError(fmt::format("--{} needs --survey", name));
    }
}

void refuse_with_survey(const po::variables_map& values, std::initializer_list<const char*> names) {
    for (const char* name : names) {
        if (given(values, name)) throw UsageError(fmt::format("--{} needs the whole log: leave out --survey", name));
    }
}

io::SurveyOrigin survey_origin(const PartOptions& options, const po::variables_map& values) {
    const io::Source log = io::map_file(options.log);
    if (!log.text().starts_with("\x89"
                                "BIIP")) {
        throw UsageError(options.log + " is not a BIIP log: only these can be read in parts",
                         "clsurf convert " + options.log + " -o run.biip");
    }
    po::options_description part;
    declare_part(part);
    io::SurveyOrigin origin;
    origin.log_sha256 = io::hash_of_ends(log);
    origin.program_sha256 = io::identify(io::open_source(options.program)).sha256;
    for (const std::string& word : words_of(part, values)) origin.options += (origin.options.empty() ? "" : " ") + word;
    return origin;
}

SurveyedLog read_surveyed_log(const PartOptions& options, const po::variables_map& values) {
    if (values.count("survey") == 0)
        throw UsageError("shards need the survey of the log", "clsurf survey part.nc run.biip -o run.survey");
    if (options.derivative != DerivativeMethod::savgol)
        throw UsageError("--derivative kalman needs the whole log; shards support savgol only");
    SurveyedLog log{survey_origin(options, values), {}};
    log.survey = io::read_survey(values["survey"].as<std::string>(), log.origin);
    return log;
}

std::optional<ShardNumber> read_shard_number(const po::variables_map& values) {
    if (values.count("shard") == 0) return std::nullopt;
    const std::string text = values["shard"].as<std::string>();
    ShardNumber shard{0, 0};
    const char* const end = text.data() + text.size();
    const auto number = std::from_chars(text.data(), end, shard.number);
    if (number.ec == std::errc() && number.ptr != end && *number.ptr == '/') {
        const auto count = std::from_chars(number.ptr + 1, end, shard.count);
        if (count.ec == std::errc() && count.ptr == end && shard.number >= 1 && shard.number <= shard.count &&
            shard.count <= most_shards)
            return shard;
    }
    throw UsageError("--shard: '" + text + "' is not a shard such as 3/8, the third of eight");
}

int read_shard_count(const po::variables_map& values) {
    const int shards = values["shards"].as<int>();
    if (shards < 1 || shards > most_shards)
        throw UsageError(fmt::format("--shards: {} is not 1 … {}", shards, most_shards));
    return shards;
}

Part load_surveyed_part(const PartOptions& options, const Survey& survey, StageClock& clock) {
    const io::PartFiles files{options.program, options.log, options.program_options, options.log_options, false};
    Part part = io::read_surveyed_part(files, rules_of(options), survey, clock.stages());
    part.tool = find_tool(options.tool, &part.log, &part.program, part.diagnostics);
    clock.end();
    return part;
}

}  // namespace clsurf::cli
