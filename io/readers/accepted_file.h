#pragma once
// A file of accepted defects (JSON): what the page of `report` saves and `check --accepted` reads. docs/accepted.md.

#include <string>
#include <vector>

namespace clsurf::io {

struct AcceptedDefect {
    std::string fingerprint;  ///< of io/reports/defect_fingerprint.h
    bool accepted = true;     ///< false: there is a comment only
    int severity = 0;         ///< when it was accepted; 0: not told, any severity is accepted
    std::string comment;
    std::string finding;  ///< what it was, for people
};

struct AcceptedFile {
    std::string name;     ///< of the file
    std::string program;  ///< that it was made for; empty: not told
    std::vector<AcceptedDefect> defects;
};

/// Throws InputError: no such file, not of this format, the same fingerprint twice.
[[nodiscard]] AcceptedFile read_accepted(const std::string& path);

}  // namespace clsurf::io
