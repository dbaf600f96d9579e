#include "cli/runs/merged_shards.h"

#include <utility>

#include "io/formats/shard_file.h"

namespace clsurf::cli {
namespace {

/// Candidates are near the ends of passes; the points between are not read.
constexpr PointIndex points_of_block = 1024;

}  // namespace

std::string shard_settings(const Part& part) { return part.tool ? "--tool " + to_text(*part.tool) : "--tool none"; }

MergedShards shards_of_files(SurveyedLog log, std::vector<std::string> paths) {
    MergedShards merged;
    merged.read = [origin = log.origin, paths = std::move(paths)](const Part& part, MotionSizes& motion) {
        std::vector<ShardFindings> shards;
        for (const std::string& path : paths) {
            shards.push_back(io::read_shard(path, origin, shard_settings(part)));
            motion.add(std::exchange(shards.back().motion, {}));
        }
        return shards;
    };
    merged.survey = std::make_shared<const Survey>(std::move(log.survey));
    return merged;
}

MergedShards shards_judged_here(SurveyedLog log, int count, std::optional<Role> measured) {
    MergedShards merged;
    merged.survey = std::make_shared<const Survey>(std::move(log.survey));
    merged.read = [survey = merged.survey, count, measured](const Part& part, MotionSizes& motion) {
        ClSurface surface = surveyed_surface(part, *survey);
        PartSignals read = surveyed_signals(part, surface, *survey, measured);
        std::vector<ShardFindings> shards;
        for (int number = 1; number <= count; ++number) {
            shards.push_back(judge_shard(part, surface, read, *survey,
                                         points_of_shard(surface.passes, survey->points, {number, count})));
            motion.add(std::exchange(shards.back().motion, {}));
            surface.positions.forget();
            read.signals.forget();
        }
        return shards;
    };
    return merged;
}

Quality judge_merged(const MergedShards& merged, const Part& part, std::optional<Role> measured, bool with_motion,
                     StageClock& clock, ClSurface& surface) {
    const Survey& survey = *merged.survey;
    MotionSizes motion;
    QualityRules rules = rules_of_shards(merged.read(part, motion), survey);
    surface = surveyed_surface(part, survey, points_of_block);
    if (merged.in_files) {
        surface.neighbours.checked.need(0, survey.points - 1);
        surface.positions = gather(part.path);
    }
    PartSignals read =
        merged.in_files ? signals_of(part, surface, measured) : surveyed_signals(part, surface, survey, measured);
    if (!merged.in_files) rules.found->forget = forget_when_many(surface.positions, read.signals);
    Quality quality = judge(part, surface, read, measured, rules, clock.stages());
    if (with_motion) quality.motion = motion_quality(motion, surface, part.log.period);
    return quality;
}

}  // namespace clsurf::cli
