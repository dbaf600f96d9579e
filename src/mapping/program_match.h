#pragma once
// ProgramMatch: whether a log belongs to a program, by its lines and its path.

#include <string>
#include <vector>

namespace clsurf {

/// Result of comparing the hashes of programs in a log (io/formats/program_identity.h).
enum class ProgramIdentity {
    unknown,  ///< the log carries none
    same,
    edited,  ///< the program has the name of one that ran, and another hash
    other,   ///< another name and another hash
};

struct ProgramMatch {
    bool edited = false;            ///< the text is not the one that ran: no line is certain
    std::string foreign;            ///< why the log does not belong to the program: a clause; empty: it does
    std::string foreign_hint = {};  ///< a possible remedy; empty: none
    double off = 0;                 ///< share of checked points that are off their lines, 0 … 1
    double missing = 0;             ///< share of the program's motions that are missing in the log, 0 … 1

    /// Reasons not to trust a comparison of passes, as sentences; empty: none.
    [[nodiscard]] std::vector<std::string> doubts() const;
};

}  // namespace clsurf
