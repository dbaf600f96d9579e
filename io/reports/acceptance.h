#pragma once
// Acceptance: which defects of a report the user has accepted, from a file with their fingerprints.
//
// A defect remains accepted while it is not more severe than when it was accepted; a worse one counts again.

#include <string>
#include <vector>

#include "core/diagnostic.h"
#include "io/readers/accepted_file.h"
#include "predictor/defect.h"

namespace clsurf::io {

struct Acceptance {
    struct Entry {
        bool listed = false;    ///< the file has an entry for the defect
        bool accepted = false;  ///< it does not count
        bool worse = false;     ///< the defect was accepted with a lower severity
        int severity = 0;       ///< severity when the defect was accepted; 0: not known
        std::string comment;
    };
    std::string file;                     ///< its name
    std::vector<Entry> of_defect;         ///< one for each defect of the report
    std::vector<AcceptedDefect> unknown;  ///< entries of the file that match no defect

    [[nodiscard]] bool accepts(std::size_t defect) const { return of_defect[defect].accepted; }
    [[nodiscard]] std::size_t count() const;  ///< number of accepted defects
};

/// Compares by fingerprint (io/reports/defect_fingerprint.h). O(n log n).
[[nodiscard]] Acceptance accept(const QualityReport& report, const AcceptedFile& file);

/// Adds warnings `quality.accepted-worse` and `quality.accepted-unknown` for accepted defects that have changed.
void note_changes(const Acceptance& acceptance, const QualityReport& report, Diagnostics& diagnostics);

/// The report with only the defects that count, for comparison with a budget.
[[nodiscard]] QualityReport without_accepted(const QualityReport& report, const Acceptance& acceptance);

/// "accepted: 2 (polished by hand), 5": their ranks; empty: none is accepted.
[[nodiscard]] std::string accepted_text(const Acceptance& acceptance);

}  // namespace clsurf::io
