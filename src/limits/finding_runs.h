#pragma once
// Records over a limit become findings: consecutive ones, and those between which the same excess may have gone on.

#include <functional>
#include <limits>
#include <vector>

#include "limits/limit_report.h"
#include "limits/motion_window.h"

namespace clsurf {

/// Consecutive records over a limit.
struct RecordRun {
    LimitFinding finding;
    double proved = 0;  ///< the greatest factor less uncertainty
    double clear = 0;   ///< of the finding: factor less what rounding and the clock make of it
    /// How far any record between the run before and this one may at least have been over the limit: the least factor plus
    /// uncertainty of them. Infinite: there are none.
    double gap_reach = std::numeric_limits<double>::infinity();
};

/// What was found of one limit in consecutive records.
struct RecordRuns {
    std::vector<RecordRun> runs;
    double gap_reach = std::numeric_limits<double>::infinity();  ///< of the records after the last run
    JudgedLimit greatest;
    bool any = false;  ///< whether any record was judged

    /// Appends what was found in the records that follow.
    void append(const RecordRuns& next);
};

/// Takes records one after the other.
class RunFinder {
public:
    explicit RunFinder(const StatedLimit& limit) { found_.greatest.limit = limit; }

    /// NaN: not known there. `limit` [as the limit]: what holds at this record.
    void add(PointIndex point, const MeasuredValue& measured, double limit);
    [[nodiscard]] RecordRuns finish() { return std::move(found_); }

private:
    RecordRuns found_;
};

/// Joins runs that may be one, of which noise hides parts: between them, for at most `longest_gap` records on the same line,
/// no record is certain to be below what is certain of both. O(runs).
[[nodiscard]] std::vector<LimitFinding> findings_of(const RecordRuns& found, PointIndex longest_gap,
                                                    const std::function<LineNumber(PointIndex)>& line_at);

}  // namespace clsurf
