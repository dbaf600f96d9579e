#pragma once
// PositionFields: fields of positions and their derivatives, computed block by block from rows (field_row.h).

#include <memory>

#include "field/field_provider.h"
#include "field/field_row.h"
#include "field/field_table.h"
#include "log/log.h"
#include "numeric/derivative.h"
#include "surface/passes.h"
#include "toolpath/motion_estimate.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// How fields are derived from positions.
struct Derivation {
    /// Derivatives by a Kalman smoother, except those of angles and tool axes; nullptr: all by least squares over a
    /// window.
    std::shared_ptr<const MotionEstimate> estimate;
    /// [s] Period of another log whose fields are to be compared; 0: none. Windows then extend across standstills: a pause has
    /// no length, so only its share of the window appears at the adjacent places.
    double coarsest_period = 0;
    double jerk_window = 0;  ///< [s] from its first point to the last one; 0: as in derivative_filter()

    /// The filter of a derivative of a log with that period.
    [[nodiscard]] DerivativeFilter filter(int derivative, double period) const;
};

class PositionFields : public FieldProvider {
public:
    /// Shares the columns of `log` and `path`; `rows` must outlive it. Derivatives are taken inside pieces of `passes`;
    /// neighbouring turns of a spiral are one piece, and a piece ends at standstills.
    PositionFields(const Log& log, const Trajectory& path, const Passes& passes, Derivation derivation = {},
                   std::span<const FieldRow> rows = field_table());

    /// The same fields, with derivatives inside pieces of other passes. O(1) if these are few.
    [[nodiscard]] PositionFields within(const Passes& passes) const;

    [[nodiscard]] std::vector<FieldInfo> fields() const override;
    [[nodiscard]] bool can_compute(std::string_view name) const override;
    /// Rows with the same subject share positions and derivatives. O(points), parallel. The values at a point do not depend
    /// on the requested `points`, except for `contour_error` at the first 256 points of a part.
    [[nodiscard]] std::vector<Field> compute(std::span<const std::string_view> names, PointRange points) const override;

private:
    [[nodiscard]] const FieldRow& row(std::string_view name) const;
    [[nodiscard]] std::string note_of(const FieldRow& row) const;

    std::shared_ptr<const Log> log_;
    Trajectory path_;
    std::vector<PointRange> pieces_;  ///< for derivatives, in order
    Derivation derivation_;
    std::span<const FieldRow> rows_;
};

}  // namespace clsurf
