#pragma once
// RunRecord: the record of one judged run in a history: its program, log and machine, the findings of `check`, and
// the parameters that its user gave it.

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry.h"
#include "core/point.h"

namespace clsurf {

/// A section of a pass with a defect.
struct RecordedSection {
    std::int64_t pass = 0;                     ///< number of the cut pass, from 1
    LineNumber first_line = 0, last_line = 0;  ///< in the main program; 0: no line
    friend bool operator==(const RecordedSection&, const RecordedSection&) = default;
};

/// A defect in shown units, with the words of reports.
struct RecordedDefect {
    std::string cause;              ///< "feed_drop"
    std::string quantity;           ///< "speed": the quantity that shows it best
    int severity = 1;               ///< 1 to 4
    double score = 0;               ///< peak over threshold
    double depth_um = 0;            ///< [µm] ≥ 0
    bool pit = false;               ///< below its neighbours
    bool systematic = false;        ///< lag that alternates with the direction of travel
    double speed_jump_percent = 0;  ///< against the neighbours, signed
    double length_mm = 0, area_mm2 = 0;
    Vec3 tip = Vec3::Zero();       ///< [mm] tool tip at its strongest place
    Vec3 position = Vec3::Zero();  ///< [mm] contact point there if the tool is known, else the tip
    std::vector<RecordedSection> sections;
};

/// A parameter of the user: "tool", "D6R3".
struct RunParameter {
    std::string name, value;
    friend bool operator==(const RunParameter&, const RunParameter&) = default;
};

/// How much the passes of a run differ from their neighbours, over the whole run. NaN: unknown.
struct RunMismatch {
    double median = std::numeric_limits<double>::quiet_NaN();
    double p99 = std::numeric_limits<double>::quiet_NaN();
};

/// NaN: unknown.
struct RunRecord {
    std::int64_t id = 0;       ///< number in its history, from 1
    std::string time;          ///< UTC, "2026-11-24T07:30:00Z"
    std::string recorded;      ///< when the row was written, in the same form
    std::string program, log;  ///< their files, as the user named them
    std::string program_sha256, log_sha256;
    std::string machine;   ///< empty: unknown
    std::string tool;      ///< "ball:6"; empty: unknown
    std::string version;   ///< of clsurf
    std::string settings;  ///< the options of `check`, as words of a command line
    std::string failure;   ///< reason why the run could not be judged at all; empty: it did not fail
    double duration_s = std::numeric_limits<double>::quiet_NaN();
    std::int64_t points = 0, passes = 0;  ///< numbers of points in cut passes, and of cut passes
    bool judged = false;
    std::string not_judged_reasons;  ///< sentences; empty: it is judged
    bool within_budget = false;
    double coverage_percent = std::numeric_limits<double>::quiet_NaN();
    RunMismatch speed_percent, acceleration_mm_s2, lag_um;
    std::int64_t defects = 0;  ///< their number
    int worst_severity = 0;    ///< 0: no defects
    double worst_score = 0;
    double deepest_um = 0;
    double area_mm2 = 0;  ///< of all defects
    double ra_um = std::numeric_limits<double>::quiet_NaN();
    double rz_um = std::numeric_limits<double>::quiet_NaN();
    std::vector<RunParameter> parameters;  ///< in the order of their names, each name once
    std::vector<RecordedDefect> found;  ///< the defects themselves, worst first; a history reads them only on request

    /// Whether nothing was measured: the counts and worst values of the run are then not 0 but unknown.
    [[nodiscard]] bool failed() const { return !failure.empty(); }
    /// The value of a parameter; nullptr if the run has none of that name.
    [[nodiscard]] const std::string* parameter(std::string_view name) const;
};

/// Identity of a run: program, log and parameters, by content. Two records of the same run have the same text, regardless
/// of the settings of `check`.
[[nodiscard]] std::string identity_text(const RunRecord& run);

/// Whether a judged run replaces a failed one: the same program and log (by name if the failed one could not be read), and at
/// least its parameters, because the parameters of a log are unknown before it is read.
[[nodiscard]] bool supersedes(const RunRecord& judged, const RunRecord& failed);

/// Sorts parameters by name. Throws UsageError for a name that is given twice.
void sort_parameters(std::vector<RunParameter>& parameters);

}  // namespace clsurf
