#pragma once
// One log, judged and reported by `check`.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/runs/checked_run.h"
#include "cli/runs/followed_check.h"
#include "cli/runs/measured_check.h"
#include "cli/runs/run_recorder.h"
#include "history/recorded_match.h"

namespace clsurf::cli {

/// The report of one log, with its verdict.
struct Checked {
    std::string text;
    ExitCode code = ExitCode::done;
    ResolvedFindings resolved;  ///< findings of a followed log
};

/// What one log is checked for, besides how it is read.
struct CheckRules {
    std::optional<Role> measured;
    CheckBudget budget;
    std::optional<std::vector<RecordedDefect>> baseline;
    std::optional<RunRecorder> recorder;
    std::unique_ptr<MeasuredInput> measured_part;  ///< nullptr: nothing was measured
    std::optional<MergedShards> merged;            ///< nothing: the log is judged as a whole
    std::string format;
    std::unique_ptr<FollowedCheck> followed;  ///< nullptr: the log is complete
};

/// Reads and judges the log of `options`, records it, compares it with the inputs of `rules`, and prints its diagnostics.
/// Throws as check_run() does.
[[nodiscard]] Checked check_log(const PartOptions& options, CheckRules& rules, const po::variables_map& values);

/// check_log() for one of several logs: an error of the log becomes its result, so that the other logs are still judged.
/// Throws errors that are not of the log: program, options, machine.
[[nodiscard]] Checked check_log_of_several(const PartOptions& options, CheckRules& rules,
                                           const po::variables_map& values);

}  // namespace clsurf::cli
