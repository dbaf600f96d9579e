#pragma once
// Fields speed_share, acceleration_share and jerk_share: the commanded motion as a share of the limits of the axes, of one
// axis (`acceleration_share.x`) or of the one with the greatest share.

#include <memory>
#include <vector>

#include "field/field_provider.h"
#include "limits/motion_window.h"

namespace clsurf {

class LimitFields : public FieldProvider {
public:
    /// Shares the columns of `log` and `path`; `path`: the commanded positions. Limits of the path are not used.
    LimitFields(Log log, Trajectory path, std::vector<StatedLimit> limits);

    [[nodiscard]] std::vector<FieldInfo> fields() const override;
    /// Whether there is a limit for the field and the log has the commanded positions.
    [[nodiscard]] bool can_compute(std::string_view name) const override;
    /// Shares as in `check`: unsmoothed, without records that seem to be lost. 1: at the limit. Throws UsageError: there is
    /// no limit. O(points · axes), parallel.
    [[nodiscard]] std::vector<Field> compute(std::span<const std::string_view> names, PointRange points) const override;

private:
    struct Row {
        FieldInfo info;
        LimitedQuantity quantity;
    };
    [[nodiscard]] static std::vector<Row> rows();
    [[nodiscard]] std::vector<StatedLimit> limits_of(const Row& row) const;

    Log log_;
    Trajectory path_;
    std::vector<StatedLimit> limits_;
};

}  // namespace clsurf
