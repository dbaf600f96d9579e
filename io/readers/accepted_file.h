#pragma once
// A file of accepted defects (JSON), saved by the page of `report` and read by `check --accepted`. docs/accepted.md.

#include <string>
#include <vector>

namespace clsurf::io {

struct AcceptedDefect {
    std::string fingerprint;  ///< as in io/reports/defect_fingerprint.h
    bool accepted = true;     ///< false: the entry is only a comment
    int severity = 0;         ///< at the time of acceptance; 0: not known, any severity is accepted
    std::string comment;
    std::string finding;  ///< description for readers
};

struct AcceptedFile {
    std::string name;     ///< name of the file
    std::string program;  ///< program of the file; empty: not given
    std::vector<AcceptedDefect> defects;
};

/// Throws InputError: missing file, wrong format, duplicate fingerprint.
[[nodiscard]] AcceptedFile read_accepted(const std::string& path);

}  // namespace clsurf::io
