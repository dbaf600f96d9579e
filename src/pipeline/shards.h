#pragma once
// Shards: parts of a long log, cut at passes, that are judged one by one, and the verdict on the whole from what was
// found in them: the same as if the log had been judged at once (docs/design/shards.md).

#include <vector>

#include "pipeline/judge.h"
#include "pipeline/survey.h"

namespace clsurf {

/// Shard `number` of `count`, from 1.
struct ShardNumber {
    int number = 1, count = 1;
};

/// The points of a shard: those of passes that begin in its share of the log. All shards together have every point once.
[[nodiscard]] PointRange points_of_shard(const Passes& passes, PointIndex points, const ShardNumber& shard);

/// What is found in a shard.
struct ShardFindings {
    PointRange points;
    ComparedPoints compared;         ///< count_compared()
    std::vector<PointIndex> starts;  ///< find_starts()
    std::vector<double> scallops;    ///< [mm] scallop_heights(), where the tool is known
    MotionSizes motion;
};

/// Judges a shard of a part that was surveyed; `surface` and `read` are those of the survey. O(points of the shard and of
/// the passes beside it), parallel.
[[nodiscard]] ShardFindings judge_shard(const Part& part, const ClSurface& surface, const PartSignals& read,
                                        const Survey& survey, const PointRange& points);

/// What was found in all shards, for judge(): in any order. Throws UsageError where a shard is missing or there twice.
[[nodiscard]] QualityRules rules_of_shards(std::vector<ShardFindings> shards, const Survey& survey);

/// For QualityRules::found: once more than `most` points were read, positions and signals take no memory any more (some 85 bytes a
/// point). Both must be those of a survey, and outlive it.
[[nodiscard]] ForgetBlocks forget_when_many(Positions& positions, Signals& signals, PointIndex most = 1 << 23);

}  // namespace clsurf
