#pragma once
// --shard and --merge of `check`; `report` has the same --shard.

#include <optional>

#include "cli/runs/checked_run.h"
#include "pipeline/shards.h"

namespace clsurf::cli {

/// --survey, --shard, --merge.
void declare_shards(po::options_description& options);

/// --shard: writes the findings of a part of the log. Throws UsageError: an option for the whole log.
ExitCode check_shard(PartOptions options, const ShardNumber& shard, const po::variables_map& values);

/// --merge; nothing: not given. `logs`: the number of logs. Throws UsageError: several logs, or --survey alone.
[[nodiscard]] std::optional<MergedShards> read_merged(const PartOptions& options, const po::variables_map& values,
                                                      std::size_t logs);

}  // namespace clsurf::cli
