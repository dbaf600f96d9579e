#pragma once
// Findings of shards as JSON, written by `clsurf check --shard` and read by `--merge` (pipeline/shards.h).

#include <string>
#include <vector>

#include "io/formats/survey_file.h"
#include "pipeline/shards.h"

namespace clsurf::io {

/// `settings`: what the findings depend on besides the survey.
[[nodiscard]] std::string shard_json(const ShardFindings& findings, const ShardNumber& shard,
                                     const SurveyOrigin& origin, const std::string& settings);

/// Throws InputError: not findings of a shard, or made for another log, program or other settings.
[[nodiscard]] ShardFindings read_shard(const std::string& path, const SurveyOrigin& origin,
                                       const std::string& settings);

}  // namespace clsurf::io
