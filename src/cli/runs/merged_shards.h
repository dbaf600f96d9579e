#pragma once
// MergedShards: the findings of all shards of a log, for `check --merge` and `report --survey`.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/survey_options.h"
#include "pipeline/judge.h"
#include "pipeline/shards.h"

namespace clsurf::cli {

struct MergedShards {
    std::shared_ptr<const Survey> survey;
    /// Reads the findings of the shards of a part. Their motion is added to `motion`, which takes less memory.
    std::function<std::vector<ShardFindings>(const Part&, MotionSizes& motion)> read;
    /// true: positions and signals of the whole log are in columns kept in files (core/column_file.h); false: in blocks that
    /// are filled when they are read.
    bool in_files = false;
};

/// The settings that the findings of a shard depend on besides its survey.
[[nodiscard]] std::string shard_settings(const Part& part);

/// From files of `check --shard`.
[[nodiscard]] MergedShards shards_of_files(SurveyedLog log, std::vector<std::string> paths);
/// From `count` shards that are judged one after another, in the memory of one.
[[nodiscard]] MergedShards shards_judged_here(SurveyedLog log, int count, std::optional<Role> measured);

/// The verdict on the whole log. Sets `surface` to that of the part; it borrows from the survey. `with_motion`: compute
/// Quality::motion. Throws as rules_of_shards() does.
[[nodiscard]] Quality judge_merged(const MergedShards& merged, const Part& part, std::optional<Role> measured,
                                   bool with_motion, StageClock& clock, ClSurface& surface);

}  // namespace clsurf::cli
