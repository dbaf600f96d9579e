#pragma once
// One log as `check` judges and reports it.

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

/// One log's report, and what it comes to.
struct Checked {
    std::string text;
    ExitCode code = ExitCode::done;
    ResolvedFindings resolved;  ///< of a log that was followed
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

/// Reads and judges the log of `options`, records it and compares it with what `rules` name, and prints its diagnostics. Throws as
/// check_run() does.
[[nodiscard]] Checked check_log(const PartOptions& options, CheckRules& rules, const po::variables_map& values);

/// check_log() of one of several logs: an error of the log is its result, so that the verdicts on the others stand.
/// Throws what is no error of the log: program, options, machine.
[[nodiscard]] Checked check_log_of_several(const PartOptions& options, CheckRules& rules,
                                           const po::variables_map& values);

}  // namespace clsurf::cli
