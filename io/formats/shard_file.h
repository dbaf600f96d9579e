#pragma once
// Findings of shards as JSON: what `clsurf check --shard` writes and `--merge` reads (pipeline/shards.h).

#include <string>
#include <vector>

#include "io/formats/survey_file.h"
#include "pipeline/shards.h"

namespace clsurf::io {

/// `settings`: what the findings depend on besides the survey.
[[nodiscard]] std::string shard_json(const ShardFindings& findings, const ShardNumber& shard,
                                     const SurveyOrigin& origin, const std::string& settings);

/// Throws InputError: no findings of a shard, or of another log, program or settings.
[[nodiscard]] ShardFindings read_shard(const std::string& path, const SurveyOrigin& origin,
                                       const std::string& settings);

}  // namespace clsurf::io
