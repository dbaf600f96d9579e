#pragma once
// `check --follow`: reports findings while a log is still being written, and confirms or withdraws them with the complete
// log.

#include <memory>
#include <optional>
#include <string>

#include "cli/options/follow.h"
#include "pipeline/followed_run.h"

namespace clsurf::cli {

class FollowedCheck {
public:
    /// `json`: the output is JSON, one object per line. `quiet`: no text is written.
    FollowedCheck(FollowOptions follow, bool json, bool quiet) : follow_(follow), json_(json), quiet_(quiet) {}

    /// Follows the log to its end, writes each finding to standard output, and sets the log of `options` to all its
    /// bytes. Throws as follow_log() and FollowedRun do.
    void follow(PartOptions& options, std::optional<Role> measured);

    [[nodiscard]] ResolvedFindings resolve(const QualityReport& complete) const;
    /// Confirms or withdraws the findings with the complete log; as JSON with the report and its exit code.
    void write_end(const ResolvedFindings& resolved, const std::string& report, ExitCode code) const;
    [[nodiscard]] bool json() const { return json_; }

private:
    void write(const std::string& text) const;

    FollowOptions follow_;
    bool json_, quiet_;
    std::optional<FollowedRun> run_;
};

/// nullptr: --follow is not given. `format`: of the report of `logs` logs. Throws UsageError: several logs, a format that
/// cannot be written while the log grows.
[[nodiscard]] std::unique_ptr<FollowedCheck> read_followed(const po::variables_map& values, const std::string& format,
                                                           std::size_t logs);

}  // namespace clsurf::cli
