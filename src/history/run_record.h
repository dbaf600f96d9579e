#pragma once
// RunRecord: what a history keeps of one judged run: which program and log it was, on which machine, what `check`
// found, and the parameters that its user gave it.

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

/// A defect in shown units, its words those of reports.
struct RecordedDefect {
    std::string cause;              ///< "feed_drop"
    std::string quantity;           ///< "speed": the one that shows it best
    int severity = 1;               ///< 1 to 4
    double score = 0;               ///< peak over threshold
    double depth_um = 0;            ///< [µm] ≥ 0
    bool pit = false;               ///< below its neighbours
    bool systematic = false;        ///< lag that alternates with the direction of travel
    double speed_jump_percent = 0;  ///< against the neighbours, signed
    double length_mm = 0, area_mm2 = 0;
    Vec3 tip = Vec3::Zero();       ///< [mm] tool tip where it is strongest
    Vec3 position = Vec3::Zero();  ///< [mm] contact point there where the tool is known, else the tip
    std::vector<RecordedSection> sections;
};

/// A parameter of the user: "tool", "D6R3".
struct RunParameter {
    std::string name, value;
    friend bool operator==(const RunParameter&, const RunParameter&) = default;
};

/// How much the passes of a run differ from their neighbours, over all of it. NaN: not known.
struct RunMismatch {
    double median = std::numeric_limits<double>::quiet_NaN();
    double p99 = std::numeric_limits<double>::quiet_NaN();
};

/// NaN: not known.
struct RunRecord {
    std::int64_t id = 0;       ///< number in its history, from 1
    std::string time;          ///< UTC, "2026-11-24T07:30:00Z"
    std::string recorded;      ///< when the row was written, in the same form
    std::string program, log;  ///< their files, as they were named
    std::string program_sha256, log_sha256;
    std::string machine;   ///< empty: not known
    std::string tool;      ///< "ball:6"; empty: not known
    std::string version;   ///< of clsurf
    std::string settings;  ///< the options that it was judged by, as words of a command line
    std::string failure;   ///< why it could not be judged at all; empty: it could
    double duration_s = std::numeric_limits<double>::quiet_NaN();
    std::int64_t points = 0, passes = 0;  ///< of cut passes
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
    std::vector<RecordedDefect> found;  ///< the defects themselves, worst first; a history reads them only where asked

    /// Nothing of it was measured: its counts and its worst values are not 0 but unknown.
    [[nodiscard]] bool failed() const { return !failure.empty(); }
    /// The value of a parameter; nullptr: the run has none of that name.
    [[nodiscard]] const std::string* parameter(std::string_view name) const;
};

/// What tells runs apart: program, log and parameters, by content. Two records of the same run have the same text, whatever
/// they were judged by.
[[nodiscard]] std::string identity_text(const RunRecord& run);

/// Whether a judged run has what a failed one could not judge: the same program and log (by name where the failed one could not
/// be read), and at least its parameters, because those of a log are not known before it is read.
[[nodiscard]] bool supersedes(const RunRecord& judged, const RunRecord& failed);

/// Puts parameters into the order of their names. Throws UsageError: a name that is given twice.
void sort_parameters(std::vector<RunParameter>& parameters);

}  // namespace clsurf
