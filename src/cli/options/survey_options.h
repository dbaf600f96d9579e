#pragma once
// --survey, --shard, --merge: a long log is surveyed once, judged in shards, and the shards are put together.

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/part.h"
#include "io/formats/survey_file.h"
#include "pipeline/shards.h"

namespace clsurf::cli {

/// --survey, --shard; `what`: what is done with a shard.
void declare_shard(po::options_description& options, const char* what);

/// Throws UsageError where one of these options is given: it goes with --survey, which is not given.
void refuse_without_survey(const po::variables_map& values, std::initializer_list<const char*> names);
/// Throws UsageError where one of these options is given: it needs the whole log.
void refuse_with_survey(const po::variables_map& values, std::initializer_list<const char*> names);

/// The survey that --survey names, and the part of the log that is looked at.
struct SurveyedLog {
    io::SurveyOrigin origin;
    Survey survey;
};

/// Of a log and a program that a survey is made for, or was made for. Throws UsageError: the log is not a BIIP file, which
/// can be read in parts; InputError.
[[nodiscard]] io::SurveyOrigin survey_origin(const PartOptions& options, const po::variables_map& values);

/// Throws UsageError: --survey is not given; InputError as read_survey() does.
[[nodiscard]] SurveyedLog read_surveyed_log(const PartOptions& options, const po::variables_map& values);

/// --shard; nothing: it is not given. Throws UsageError: not I/N.
[[nodiscard]] std::optional<ShardNumber> read_shard_number(const po::variables_map& values);

/// --shards: how many there are. Throws UsageError: not 1 … 1,000,000.
[[nodiscard]] int read_shard_count(const po::variables_map& values);

/// The part of a log that was surveyed, with its tool. Throws as read_surveyed_part() does.
[[nodiscard]] Part load_surveyed_part(const PartOptions& options, const Survey& survey, StageClock& clock);

}  // namespace clsurf::cli
