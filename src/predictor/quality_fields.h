#pragma once
// The fields of the predictor: differences of a point to the adjacent passes, as colours and curves.
//
// To add one: a row of `quality_rows` in quality_fields.cpp.

#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>

#include "field/field_provider.h"
#include "predictor/mismatch.h"

namespace clsurf {

struct QualityFieldRow {
    std::string_view name, label;
    std::string_view label_unmeasured;  ///< label if measured positions are not known; empty: the same label
    Unit unit;
    FieldScale scale = FieldScale::sequential;
    std::string Signals::*windows = nullptr;  ///< note with the smoothing windows of the compared quantities
    /// Value of a point that is compared; NaN if there is no neighbour on either side.
    float (*value)(const Comparer& comparer, const Signals& signals, PointIndex point) = nullptr;
    // As in FieldInfo:
    std::string_view also;
    int report_rank = 0;
    bool percentiles = false;
    /// Step above which it is a discontinuity, inside units. A picture spans at least two of them.
    float (*threshold)(const Thresholds& thresholds, bool measured) = nullptr;
    FieldPreference preference = FieldPreference::none;
};

/// speed_mismatch, acceleration_mismatch, height, speed_difference.
[[nodiscard]] std::span<const QualityFieldRow> quality_field_table();

class QualityFields : public FieldProvider {
public:
    /// `derive` returns the signals along the path of the surface; it is called once, for the first field. The surface and
    /// `table` must outlive this.
    QualityFields(const ClSurface& surface, std::function<Signals()> derive,
                  std::span<const QualityFieldRow> table = quality_field_table());

    [[nodiscard]] std::vector<FieldInfo> fields() const override;
    /// NaN if a point has no neighbour on either side. For all points, the note says how many of the cutting ones have a value.
    /// O(points), parallel.
    [[nodiscard]] std::vector<Field> compute(std::span<const std::string_view> names, PointRange points) const override;

private:
    const ClSurface& surface_;
    std::function<Signals()> derive_;
    std::span<const QualityFieldRow> table_;
    mutable std::once_flag derived_;
    mutable std::optional<Signals> signals_;
    mutable Thresholds thresholds_;
};

/// The larger of the differences in speed to both adjacent passes [mm/s], signed; NaN if there is none. O(points), parallel.
[[nodiscard]] Column<float> speed_differences(const ClSurface& surface, const Signals& signals);
/// The same for some points.
[[nodiscard]] Column<float> speed_differences(const ClSurface& surface, const Signals& signals,
                                              const PointRange& points);

}  // namespace clsurf
