#include "pipeline/shards.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "machined/as_machined_report.h"
#include "predictor/candidates.h"

namespace clsurf {
namespace {

/// The first point of the first pass that begins at or after a point.
PointIndex next_pass(const Passes& passes, PointIndex points, PointIndex from) {
    const auto next =
        std::lower_bound(passes.begin(), passes.end(), from, [](const Pass& p, PointIndex i) { return p.first < i; });
    return next == passes.end() ? points : next->first;
}

}  // namespace

PointRange points_of_shard(const Passes& passes, PointIndex points, const ShardNumber& shard) {
    const auto begin = [&](int number) {
        if (number == 0) return PointIndex{0};
        if (number == shard.count) return points;
        return next_pass(passes, points, points / shard.count * number + points % shard.count * number / shard.count);
    };
    return {begin(shard.number - 1), begin(shard.number) - 1};
}

ShardFindings judge_shard(const Part& part, const ClSurface& surface, const PartSignals& read, const Survey& survey,
                          const PointRange& points) {
    ShardFindings findings;
    findings.points = points;
    if (points.size() <= 0) return findings;
    findings.motion = motion_sizes(part.log, part.path, surface, read.signals, points);
    if (surface.step_over <= 0) return findings;
    const ArcLength arc_length(surface.positions);
    findings.compared = count_compared(surface, read.signals, points);
    findings.starts = find_starts(surface, read.signals, arc_length, survey.thresholds, points);
    if (part.tool) findings.scallops = scallop_heights(surface, read.signals, *part.tool, points);
    return findings;
}

ForgetBlocks forget_when_many(Positions& positions, Signals& signals, PointIndex most) {
    return [&positions, &signals, most, before = PointIndex{0}]() mutable {
        const PointIndex now = std::max(positions.fill->filled(), signals.motion->filled());
        if (now - before <= most) return false;
        before = now;
        positions.forget();
        signals.forget();
        return true;
    };
}

QualityRules rules_of_shards(std::vector<ShardFindings> shards, const Survey& survey) {
    std::erase_if(shards, [](const ShardFindings& shard) { return shard.points.size() <= 0; });
    std::sort(shards.begin(), shards.end(),
              [](const ShardFindings& a, const ShardFindings& b) { return a.points.first < b.points.first; });
    QualityRules rules;
    rules.fixed = survey.thresholds;
    FoundInShards& found = rules.found.emplace();
    PointIndex next = 0;
    for (const ShardFindings& shard : shards) {
        if (shard.points.first != next) {
            throw UsageError(
                shard.points.first < next
                    ? fmt::format("points {} … {} are in two of the shards", shard.points.first, next - 1)
                    : fmt::format("points {} … {} are in none of the shards", next, shard.points.first - 1));
        }
        next = shard.points.last + 1;
        found.points += shard.compared;
        found.starts.insert(found.starts.end(), shard.starts.begin(), shard.starts.end());
        found.scallops.insert(found.scallops.end(), shard.scallops.begin(), shard.scallops.end());
    }
    if (next != survey.points)
        throw UsageError(fmt::format("points {} … {} are in none of the shards", next, survey.points - 1));
    return rules;
}

}  // namespace clsurf
