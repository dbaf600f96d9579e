#pragma once
// MergedShards: what was found in all shards of a log, for whoever shows the whole of it: `check --merge`, `report --survey`.

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
    /// Of the shards of that part. Their motion is added to `motion`, which takes less memory.
    std::function<std::vector<ShardFindings>(const Part&, MotionSizes& motion)> read;
    /// Positions and signals are those of the whole log, in columns that are kept in files (core/column_file.h). Else of blocks,
    /// which are filled when they are read.
    bool in_files = false;
};

/// What the findings of a shard depend on besides its survey.
[[nodiscard]] std::string shard_settings(const Part& part);

/// From files of `check --shard`.
[[nodiscard]] MergedShards shards_of_files(SurveyedLog log, std::vector<std::string> paths);
/// From `count` shards that are judged one after the other, with the memory of one.
[[nodiscard]] MergedShards shards_judged_here(SurveyedLog log, int count, std::optional<Role> measured);

/// The verdict on the whole log. `surface` becomes that of the part, and borrows from the survey; `with_motion`: Quality::motion is
/// asked for. Throws as rules_of_shards() does.
[[nodiscard]] Quality judge_merged(const MergedShards& merged, const Part& part, std::optional<Role> measured,
                                   bool with_motion, StageClock& clock, ClSurface& surface);

}  // namespace clsurf::cli
