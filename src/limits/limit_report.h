#pragma once
// LimitReport: where a recorded motion exceeds the limits of its machine, and by how much.

#include <string>
#include <vector>

#include "core/diagnostic.h"
#include "core/geometry.h"
#include "core/point.h"
#include "machine/limit_table.h"

namespace clsurf {

/// Records over one limit by more than their uncertainty; between them the same excess may have gone on.
struct LimitFinding {
    StatedLimit limit;
    double value = 0;               ///< the greatest, in the unit of the limit
    double factor = 0;              ///< value / limit
    double uncertainty = 0;         ///< of the factor: what rounding of positions, the clock and bends can be
    PointRange points;              ///< the records
    PointIndex point = 0;           ///< where the value is greatest
    double time = 0, duration = 0;  ///< [s]
    LineNumber line = 0;            ///< of the position; 0: none
    Vec3 tip = Vec3::Zero();        ///< [mm] in the workpiece
};

/// A limit that the motion was compared with.
struct JudgedLimit {
    StatedLimit limit;
    double factor = 0;       ///< of the record where factor less uncertainty is greatest
    double uncertainty = 0;  ///< of this factor
};

struct LimitReport {
    std::vector<LimitFinding> findings;  ///< by falling factor
    std::vector<JudgedLimit> judged;
    PointIndex line_lead = 0;     ///< records by which reported lines lead the positions
    PointIndex broken_steps = 0;  ///< lost or repeated records and jumps: not judged there
    Diagnostics diagnostics;      ///< `limits.…`

    /// What is certain of the worst limit: its factor where it is exceeded, else at most 1. NaN: nothing was judged.
    [[nodiscard]] double greatest_factor() const;
};

[[nodiscard]] std::string_view name_of(LimitedQuantity quantity);
/// "x", "path".
[[nodiscard]] std::string axis_name(const StatedLimit& limit);
/// The unit that reports have it in.
[[nodiscard]] const Unit& unit_of(const StatedLimit& limit);
/// "acceleration of x", "normal acceleration of the path".
[[nodiscard]] std::string words_of(const StatedLimit& limit);

/// By falling factor; equal ones by time.
void sort_findings(std::vector<LimitFinding>& findings);

}  // namespace clsurf
