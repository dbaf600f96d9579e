#pragma once
// Acceptance: which defects of a report the user has accepted, by a file that names them by their fingerprints.
//
// A defect stays accepted as long as it is not more severe than when it was accepted. One that became worse counts again.

#include <string>
#include <vector>

#include "core/diagnostic.h"
#include "io/readers/accepted_file.h"
#include "predictor/defect.h"

namespace clsurf::io {

struct Acceptance {
    struct Entry {
        bool listed = false;    ///< the file names it
        bool accepted = false;  ///< it does not count
        bool worse = false;     ///< it was accepted, with a lower severity
        int severity = 0;       ///< when it was accepted; 0: not told
        std::string comment;
    };
    std::string file;                     ///< its name
    std::vector<Entry> of_defect;         ///< one for each defect of the report
    std::vector<AcceptedDefect> unknown;  ///< named by the file, and not among the defects

    [[nodiscard]] bool accepts(std::size_t defect) const { return of_defect[defect].accepted; }
    [[nodiscard]] std::size_t count() const;  ///< of accepted ones
};

/// Compares by fingerprint (io/reports/defect_fingerprint.h). O(n log n).
[[nodiscard]] Acceptance accept(const QualityReport& report, const AcceptedFile& file);

/// Warnings `quality.accepted-worse` and `quality.accepted-unknown`: what was accepted and is otherwise now.
void note_changes(const Acceptance& acceptance, const QualityReport& report, Diagnostics& diagnostics);

/// The report with the defects that count: what a budget is compared with.
[[nodiscard]] QualityReport without_accepted(const QualityReport& report, const Acceptance& acceptance);

/// "accepted: 2 (polished by hand), 5": their ranks; empty: none is.
[[nodiscard]] std::string accepted_text(const Acceptance& acceptance);

}  // namespace clsurf::io
