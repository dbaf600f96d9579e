#pragma once
// LimitReport: the places where a recorded motion exceeds the limits of its machine, and by how much.

#include <string>
#include <vector>

#include "core/diagnostic.h"
#include "core/geometry.h"
#include "core/point.h"
#include "machine/limit_table.h"

namespace clsurf {

/// Records that exceed one limit by more than their uncertainty; between them the excess may have continued.
struct LimitFinding {
    StatedLimit limit;
    double value = 0;               ///< the greatest, in the unit of the limit
    double factor = 0;              ///< value / limit
    double uncertainty = 0;         ///< of the factor, from rounding of positions, the clock and bends
    PointRange points;              ///< the records
    PointIndex point = 0;           ///< where the value is greatest
    double time = 0, duration = 0;  ///< [s]
    LineNumber line = 0;            ///< of the position; 0: none
    Vec3 tip = Vec3::Zero();        ///< [mm] in the workpiece
};

/// A limit with which the motion was compared.
struct JudgedLimit {
    StatedLimit limit;
    double factor = 0;       ///< factor of the record with the greatest factor minus uncertainty
    double uncertainty = 0;  ///< uncertainty of this factor
};

struct LimitReport {
    std::vector<LimitFinding> findings;  ///< in descending order of the factor
    std::vector<JudgedLimit> judged;
    PointIndex line_lead = 0;     ///< number of records by which reported lines lead the positions
    PointIndex broken_steps = 0;  ///< lost or repeated records and jumps, which are not judged
    Diagnostics diagnostics;      ///< `limits.…`

    /// The certain factor of the worst limit: its factor if it is exceeded, else at most 1. NaN: nothing was judged.
    [[nodiscard]] double greatest_factor() const;
};

[[nodiscard]] std::string_view name_of(LimitedQuantity quantity);
/// "x", "path".
[[nodiscard]] std::string axis_name(const StatedLimit& limit);
/// The unit in reports.
[[nodiscard]] const Unit& unit_of(const StatedLimit& limit);
/// "acceleration of x", "normal acceleration of the path".
[[nodiscard]] std::string words_of(const StatedLimit& limit);

/// In descending order of the factor; equal ones by time.
void sort_findings(std::vector<LimitFinding>& findings);

}  // namespace clsurf
