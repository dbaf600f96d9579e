#pragma once
// ProgramMatch: whether a log belongs to a program, as far as its lines and its path tell.

#include <string>
#include <vector>

namespace clsurf {

/// What the hashes say that a log carries of its programs (io/formats/program_identity.h).
enum class ProgramIdentity {
    unknown,  ///< the log carries none
    same,
    edited,  ///< the program has the name of one that ran, and another hash
    other,   ///< another name and another hash
};

struct ProgramMatch {
    bool edited = false;            ///< the text is not the one that ran: no line is certain
    std::string foreign;            ///< why the log does not belong to the program: a clause; empty: it does
    std::string foreign_hint = {};  ///< what may help then; empty: nothing in particular
    double off = 0;                 ///< share of checked points that lie off their lines, 0 … 1
    double missing = 0;             ///< share of the program's motions that the log does not have, 0 … 1

    /// Why a comparison of passes must not be trusted, as sentences; empty: nothing speaks against it.
    [[nodiscard]] std::vector<std::string> doubts() const;
};

}  // namespace clsurf
