#pragma once
// Survey files (.survey), written by `clsurf survey` and read for the shards of a log (pipeline/survey.h). A survey is valid
// for one log and one version of clsurf.

#include <cstdint>
#include <string>

#include "io/files/mapped_file.h"
#include "pipeline/survey.h"

namespace clsurf::io {

/// What a survey was made from.
struct SurveyOrigin {
    std::string log_sha256;      ///< hash of the log's size, its first and its last megabyte
    std::string program_sha256;  ///< hash of the main program; empty: no program
    std::string options;         ///< the relevant options, as on a command line

    friend bool operator==(const SurveyOrigin&, const SurveyOrigin&) = default;
};

/// The hash of a log for SurveyOrigin. Reads two megabytes of a large file.
[[nodiscard]] std::string hash_of_ends(const Source& log);

/// Throws SystemError, UsageError as AtomicFile does.
void write_survey(const std::string& path, const Survey& survey, const SurveyOrigin& origin);

/// A survey whose columns are views on the mapped file. Throws InputError: not a survey, another version, damaged, or
/// made for another log, program or other options than those in `origin`.
[[nodiscard]] Survey read_survey(const std::string& path, const SurveyOrigin& origin);

}  // namespace clsurf::io
