#pragma once
// The field `feed_share`: the path speed as a share of the programmed feed.

#include <memory>
#include <vector>

#include "field/field_provider.h"
#include "field/position_fields.h"
#include "mapping/line_map.h"
#include "pipeline/part.h"
#include "predictor/defect.h"
#include "program/program.h"

namespace clsurf {

[[nodiscard]] FieldInfo feed_share_info();

/// The programmed feed at a point of a part [mm/s]; NaN: not known.
[[nodiscard]] double programmed_feed_at(const Part& part, PointIndex point);

/// Speeds as shares of the programmed feed at the place; without a feed, of the usual speed.
struct SpeedShares {
    double at_defect = 0;
    double adjacent = 0;  ///< on the adjacent passes
};
/// One for each defect of a report on the part.
[[nodiscard]] std::vector<SpeedShares> speed_shares(const QualityReport& report, const Part& part);

class FeedFields : public FieldProvider {
public:
    /// `program` must outlive the object. `positions` has the field `speed`.
    FeedFields(const Program& program, std::shared_ptr<const LineMap> lines,
               std::shared_ptr<const PositionFields> positions)
        : program_(program), lines_(std::move(lines)), positions_(std::move(positions)) {}

    [[nodiscard]] std::vector<FieldInfo> fields() const override;
    /// Whether any motion of the program has a feed.
    [[nodiscard]] bool can_compute(std::string_view name) const override;
    /// 1: as fast as programmed. NaN at rapids, and if the motion is unknown. Throws UsageError: no motion has a feed.
    /// O(points), parallel.
    [[nodiscard]] std::vector<Field> compute(std::span<const std::string_view> names, PointRange points) const override;

private:
    const Program& program_;
    std::shared_ptr<const LineMap> lines_;
    std::shared_ptr<const PositionFields> positions_;
};

}  // namespace clsurf
