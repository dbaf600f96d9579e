#pragma once
// The options of `optimize`.

#include <optional>
#include <vector>

#include "cli/options/options.h"
#include "log/log.h"
#include "repair/controller_repair.h"

namespace clsurf::cli {

void declare_optimize(po::options_description& options);
/// The number of runs of --controller. Throws UsageError.
[[nodiscard]] int read_runs(const po::variables_map& values);
/// Throws UsageError.
[[nodiscard]] OptimizeRules read_optimize_rules(const po::variables_map& values);
/// The pairs of --round: a repaired program and the log of its run. Throws UsageError: not pairs, or neither --log nor
/// --controller.
[[nodiscard]] std::vector<EarlierRound> read_rounds(const po::variables_map& values);
/// The recorded run of --log. Throws UsageError if its options are given without it.
[[nodiscard]] std::optional<Log> read_measured(const po::variables_map& values, bool five_axes);

}  // namespace clsurf::cli
