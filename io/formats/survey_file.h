#pragma once
// Survey files (.survey): what `clsurf survey` finds and the shards of a log read (pipeline/survey.h). They are made
// for one log by one version of clsurf: another version asks for another survey.

#include <cstdint>
#include <string>

#include "io/files/mapped_file.h"
#include "pipeline/survey.h"

namespace clsurf::io {

/// What a survey is of.
struct SurveyOrigin {
    std::string log_sha256;      ///< of its size, its first and its last megabyte
    std::string program_sha256;  ///< of the main program; empty: no program
    std::string options;         ///< those that it depends on, as words of a command line

    friend bool operator==(const SurveyOrigin&, const SurveyOrigin&) = default;
};

/// The hash of a log for SurveyOrigin. Of a large file two megabytes are read.
[[nodiscard]] std::string hash_of_ends(const Source& log);

/// Throws SystemError, UsageError as AtomicFile does.
void write_survey(const std::string& path, const Survey& survey, const SurveyOrigin& origin);

/// A survey whose columns are those of the mapped file. Throws InputError: no survey, one of another version, damaged, or
/// of another log, program or other options than `origin` says.
[[nodiscard]] Survey read_survey(const std::string& path, const SurveyOrigin& origin);

}  // namespace clsurf::io
