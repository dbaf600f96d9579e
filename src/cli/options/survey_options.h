#pragma once
// --survey, --shard, --merge: a long log is surveyed once and judged in shards, whose results are merged.

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/part.h"
#include "io/formats/survey_file.h"
#include "pipeline/shards.h"

namespace clsurf::cli {

/// --survey, --shard; `what`: the action for a shard.
void declare_shard(po::options_description& options, const char* what);

/// Throws UsageError if one of these options is given without --survey, which it needs.
void refuse_without_survey(const po::variables_map& values, std::initializer_list<const char*> names);
/// Throws UsageError if one of these options is given: it needs the whole log.
void refuse_with_survey(const po::variables_map& values, std::initializer_list<const char*> names);

/// The survey of --survey, and the selected part of the log.
struct SurveyedLog {
    io::SurveyOrigin origin;
    Survey survey;
};

/// The origin of a survey for a log and a program. Throws UsageError: the log is not a BIIP file, which
/// can be read in parts; InputError.
[[nodiscard]] io::SurveyOrigin survey_origin(const PartOptions& options, const po::variables_map& values);

/// Throws UsageError: --survey is not given; InputError as read_survey() does.
[[nodiscard]] SurveyedLog read_surveyed_log(const PartOptions& options, const po::variables_map& values);

/// --shard; nothing: not given. Throws UsageError: not I/N.
[[nodiscard]] std::optional<ShardNumber> read_shard_number(const po::variables_map& values);

/// --shards: the number of shards. Throws UsageError: not 1 … 1,000,000.
[[nodiscard]] int read_shard_count(const po::variables_map& values);

/// A part of a surveyed log, with its tool. Throws as read_surveyed_part() does.
[[nodiscard]] Part load_surveyed_part(const PartOptions& options, const Survey& survey, StageClock& clock);

}  // namespace clsurf::cli
