#pragma once
// Shards: parts of a long log, cut at passes, that are judged one by one, and the verdict on the whole log from their
// results: the same as if the log had been judged at once (docs/design/shards.md).

#include <vector>

#include "pipeline/judge.h"
#include "pipeline/survey.h"

namespace clsurf {

/// Shard `number` of `count`, from 1.
struct ShardNumber {
    int number = 1, count = 1;
};

/// The points of a shard: those of passes that begin in its share of the log. Every point belongs to exactly one shard.
[[nodiscard]] PointRange points_of_shard(const Passes& passes, PointIndex points, const ShardNumber& shard);

/// The results of a shard.
struct ShardFindings {
    PointRange points;
    ComparedPoints compared;         ///< count_compared()
    std::vector<PointIndex> starts;  ///< find_starts()
    std::vector<double> scallops;    ///< [mm] scallop_heights(), if the tool is known
    MotionSizes motion;
};

/// Judges a shard of a surveyed part; `surface` and `read` are those of the survey. O(points of the shard and of the
/// adjacent passes), parallel.
[[nodiscard]] ShardFindings judge_shard(const Part& part, const ClSurface& surface, const PartSignals& read,
                                        const Survey& survey, const PointRange& points);

/// The results of all shards, in any order, as input of judge(). Throws UsageError if a shard is missing or occurs twice.
[[nodiscard]] QualityRules rules_of_shards(std::vector<ShardFindings> shards, const Survey& survey);

/// For QualityRules::found: after more than `most` points were read, releases the memory of positions and signals (about 85
/// bytes per point). Both must come from a survey and outlive the result.
[[nodiscard]] ForgetBlocks forget_when_many(Positions& positions, Signals& signals, PointIndex most = 1 << 23);

}  // namespace clsurf
