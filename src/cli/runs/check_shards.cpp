#include "cli/runs/check_shards.h"

#include <fmt/format.h>

#include "cli/options/survey_options.h"
#include "cli/runs/merged_shards.h"
#include "core/column_file.h"
#include "io/files/atomic_file.h"
#include "io/formats/shard_file.h"

namespace clsurf::cli {

void declare_shards(po::options_description& options) {
    declare_shard(options,
                  "judge one of N parts of the log, cut at passes, and write what is found to -o FILE for --merge");
    options.add_options()("merge", po::value<std::vector<std::string>>()->multitoken()->value_name("FILE…"),
                          "the verdict on the whole log from what was found in all of its shards");
    options.add_options()(
        "scratch", po::value<std::string>()->value_name("FOLDER"),
        "with --merge: keep the data of the log in files in this folder instead of in memory (84 bytes a point)");
}

ExitCode check_shard(PartOptions options, const ShardNumber& shard, const po::variables_map& values) {
    for (const char* name :
         {"merge", "shards", "scratch", "budget", "fail-on", "accepted", "max-depth", "baseline", "record", "measured",
          "follow", "format", "json", "before", "fields", "color", "max-size", "gl"}) {
        if (given(values, name))
            throw UsageError(fmt::format("--{} does not apply to --shard, only to the whole log", name),
                             "give it where the shards are merged");
    }
    const std::string output = required(values, "output");
    io::AtomicFile file(output);
    StageClock clock(read_common(values), 4);
    const SurveyedLog log = read_surveyed_log(options, values);
    const std::optional<Role> measured = take_measured_role(options);
    const Part part = load_surveyed_part(options, log.survey, clock);
    refuse_tilted_tool(part);
    clock.begin("judge the shard");
    const ClSurface surface = surveyed_surface(part, log.survey);
    const PartSignals read = surveyed_signals(part, surface, log.survey, measured);
    const PointRange points = points_of_shard(surface.passes, log.survey.points, shard);
    const ShardFindings findings = judge_shard(part, surface, read, log.survey, points);
    clock.end();
    file.write(io::shard_json(findings, shard, log.origin, shard_settings(part)));
    file.commit();
    write_answer(fmt::format("shard {}/{}: {} points, {} read, {} candidates\n", shard.number, shard.count,
                             points.size(), surface.positions.fill->filled(), findings.starts.size()),
                 values);
    return ExitCode::done;
}

std::optional<MergedShards> read_merged(const PartOptions& options, const po::variables_map& values, std::size_t logs) {
    if (values.count("merge") == 0) {
        if (given(values, "survey")) throw UsageError("--survey needs --shard or --merge");
        if (given(values, "scratch")) throw UsageError("--scratch needs --merge");
        return std::nullopt;
    }
    if (logs > 1) throw UsageError("--merge takes one log");
    for (const char* name : {"measured", "follow"}) {
        if (given(values, name))
            throw UsageError(fmt::format("--{} cannot be combined with --merge: it needs the whole log", name));
    }
    MergedShards merged =
        shards_of_files(read_surveyed_log(options, values), values["merge"].as<std::vector<std::string>>());
    if (given(values, "scratch")) {
        merged.in_files = true;
        keep_columns_in(values["scratch"].as<std::string>());
    }
    return merged;
}

}  // namespace clsurf::cli
