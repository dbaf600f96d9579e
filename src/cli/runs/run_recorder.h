#pragma once
// RunRecorder: adds judged runs to a history (--param, --time, --parameters).

#include <string>
#include <vector>

#include "cli/runs/checked_run.h"
#include "history/parameter_rules.h"
#include "io/history/history_database.h"

namespace clsurf::cli {

/// --param, --time, --parameters.
void declare_recording(po::options_description& options);

/// Throws UsageError: standard input, which cannot be read again for its hash.
void require_files(const std::string& program, const std::vector<std::string>& logs);

class RunRecorder;

/// --record of `check`; nothing: not given. Throws UsageError: --param, --time or --parameters without it, standard
/// input, and as RunRecorder does.
[[nodiscard]] std::optional<RunRecorder> read_recorder(const po::variables_map& values, const std::string& program,
                                                       const std::vector<std::string>& logs);

/// The options for judging a run, as words of a command line, with the beginning of the hash of each file that they
/// name: one version of clsurf judges two runs with the same settings by the same rules.
[[nodiscard]] std::string settings_of(const po::variables_map& values);

/// SHA-256 of a file; empty: it cannot be read.
[[nodiscard]] std::string hash_of(const std::string& path);

class RunRecorder {
public:
    /// Checks before the work whether an existing database can be used, and the parameters.
    /// Throws UsageError, InputError.
    RunRecorder(std::string database, const po::variables_map& values);

    /// Adds the run with its parameters_with(). Throws SystemError, UsageError.
    io::AddedRun add(const PartOptions& options, const CheckedRun& run) const;
    /// "run 12 of shop.db", and what happened to an existing run.
    [[nodiscard]] std::string text_of(const io::AddedRun& added) const;

    /// --param.
    [[nodiscard]] const std::vector<RunParameter>& parameters() const { return parameters_; }
    /// The parameters of a run: those of --param, and the others of its log. Throws UsageError: a parameter of the log is not
    /// allowed, or a required one is missing.
    [[nodiscard]] std::vector<RunParameter> parameters_with(std::vector<RunParameter> of_log) const;
    /// --time; empty: not given.
    [[nodiscard]] const std::string& time() const { return time_; }

private:
    std::string database_;
    std::string settings_;
    std::string time_;                     ///< empty: the time of the log's file
    std::optional<ParameterRules> rules_;  ///< --parameters
    ParameterRules in_force_;              ///< rules_, otherwise those of the database
    std::vector<RunParameter> parameters_;
};

}  // namespace clsurf::cli
