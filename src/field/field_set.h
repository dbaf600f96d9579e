#pragma once
// FieldSet: computes the fields that are asked for, block by block, from the log and the passes.
//
// To add a field: one row in field_table.cpp.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "field/field.h"
#include "log/log.h"
#include "surface/passes.h"
#include "toolpath/motion_estimate.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// How fields are taken from positions.
struct Derivation {
    /// Derivatives by a Kalman smoother, those of angles and tool axes apart; nullptr: all by least squares
    /// over a window.
    std::shared_ptr<const MotionEstimate> estimate;
    /// [s] of another log whose fields are to be compared; 0: none. Windows then reach over standstills: a pause takes no
    /// way, and only what they see of it shows at the places beside it.
    double coarsest_period = 0;
};

class FieldSet {
public:
    /// `log`, `path` and `passes` must outlive it. Derivatives are taken inside pieces of `passes`;
    /// neighbouring turns of a spiral count as one piece, and where the tool stands a piece ends.
    FieldSet(const Log& log, const Trajectory& path, const Passes& passes, Derivation derivation = {});

    /// The table or the log has a field of that name.
    [[nodiscard]] bool has(std::string_view name) const;

    /// One value per point. Throws UsageError: an unknown field (with a suggestion), a field that
    /// needs a role that the log does not have. O(points), parallel.
    [[nodiscard]] Field get(std::string_view name) const;

    /// The values of points [first, last] only. O(last − first + window).
    [[nodiscard]] std::vector<double> values(std::string_view name, PointRange points) const;

private:
    const Log& log_;
    const Trajectory& path_;
    std::vector<PointRange> pieces_;  ///< for derivatives, in order
    Derivation derivation_;
};

/// Throws UsageError: none of `fields` is called that; the nearest is suggested.
[[noreturn]] void unknown_field(std::string_view name, const std::vector<FieldInfo>& fields);

/// All fields by name: those of the table, then the log's channels (nullptr: no log).
[[nodiscard]] std::vector<FieldInfo> known_fields(const Log* log);

}  // namespace clsurf
