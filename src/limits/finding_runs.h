#pragma once
// Combines records over a limit into findings: consecutive records, and those between which the excess may have continued.

#include <functional>
#include <limits>
#include <vector>

#include "limits/limit_report.h"
#include "limits/motion_window.h"

namespace clsurf {

/// Consecutive records over a limit.
struct RecordRun {
    LimitFinding finding;
    double least_factor = 0;  ///< the greatest factor minus uncertainty
    double clear = 0;         ///< factor of the finding minus the effects of rounding and the clock
    /// Upper bound of the excess in the gap to the previous run: the least factor plus uncertainty of the records between.
    /// Infinite: there are no such records.
    double gap_reach = std::numeric_limits<double>::infinity();
};

/// The runs of one limit in consecutive records.
struct RecordRuns {
    std::vector<RecordRun> runs;
    double gap_reach = std::numeric_limits<double>::infinity();  ///< of the records after the last run
    JudgedLimit greatest;
    bool any = false;  ///< whether any record was judged

    /// Appends the runs of the following records.
    void append(const RecordRuns& next);
};

/// Takes records one by one.
class RunFinder {
public:
    explicit RunFinder(const StatedLimit& limit) { found_.greatest.limit = limit; }

    /// NaN: not known. `limit` [unit of the limit]: its value at this record.
    void add(PointIndex point, const MeasuredValue& measured, double limit);
    [[nodiscard]] RecordRuns finish() { return std::move(found_); }

private:
    RecordRuns found_;
};

/// Joins runs that may be one, if noise hides parts of the excess: between them there are at most `longest_gap` records, on
/// the same line, and no record that is certainly below the certain excess of both. O(runs).
[[nodiscard]] std::vector<LimitFinding> findings_of(const RecordRuns& found, PointIndex longest_gap,
                                                    const std::function<LineNumber(PointIndex)>& line_at);

}  // namespace clsurf
