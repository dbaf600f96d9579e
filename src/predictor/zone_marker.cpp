#include "predictor/zone_marker.h"

#include <algorithm>
#include <cmath>

#include "core/point_count.h"
#include "core/point_ranges.h"

namespace clsurf {
namespace {

constexpr double longest_ramp = 20.0;   ///< [mm] 100 mm/s are reached over 17 mm at 300 mm/s²
constexpr double rise_seconds = 0.005;  ///< [s] time within which the speed of a ramp rises …
constexpr float least_rise = 0.005F;    ///< … by at least this share
// A tenth of a short pass: docs/design/predictor.md#4-join-places-into-defects, not judged.
constexpr double end_share = 0.1;   ///< largest share of a pass that is not judged at either end
constexpr double sum_rounding = 1;  ///< [mm] tolerance for arc lengths that are summed from different points

}  // namespace

ZoneMarker::ZoneMarker(const Passes& passes, const std::vector<PointRange>& pieces, const ArcLength& arc_length,
                       const EndZone& end_zone, double period, SamplesInWork samples)
    : passes_(passes),
      pieces_(pieces),
      arc_length_(arc_length),
      end_zone_(end_zone),
      reach_(2 * end_zone.usual + longest_ramp),
      stride_(points_in(rise_seconds, period)),
      samples_(samples) {}

void ZoneMarker::mark(const PointRange& points) const {
    for (auto pass = range_at(passes_, points.first); pass != passes_.end() && pass->first <= points.last; ++pass) {
        const Zone zone = pass->kind == PassKind::cut ? Zone::inner : Zone::outside;
        for (PointIndex i = std::max(points.first, pass->first); i <= std::min(points.last, pass->last); ++i)
            samples_[i].zone = zone;
    }
    const double reach = reach_ + sum_rounding;
    for (auto piece = range_at(pieces_, points.first); piece != pieces_.end() && piece->first <= points.last; ++piece) {
        if (piece->last < points.first) continue;
        if (piece->first >= points.first || !arc_length_.at_least(piece->first, points.first, reach))
            mark_end(piece->first, piece->size(), end_zone_of(*piece), +1, points);
        if (piece->last <= points.last || !arc_length_.at_least(points.last, piece->last, reach))
            mark_end(piece->last, piece->size(), end_zone_of(*piece), -1, points);
    }
}

double ZoneMarker::end_zone_of(const PointRange& piece) const {
    if (arc_length_.at_least(piece.first, piece.last, end_zone_.usual / end_share)) return end_zone_.usual;
    const double length = arc_length_.to(piece.last) - arc_length_.to(piece.first);
    return std::clamp(end_share * length, end_zone_.shortest, end_zone_.usual);
}

void ZoneMarker::mark_end(PointIndex end, PointIndex count, double zone_length, int direction,
                          const PointRange& points) const {
    double gone = 0;
    float before = 0;
    bool ramp = true;
    for (PointIndex k = 0; k < count; ++k) {
        const PointIndex i = end + direction * k;
        if (direction > 0 ? i > points.last : i < points.first) return;
        ramp = ramp && gone < zone_length + longest_ramp;
        if (gone > reach_) return;
        if (i >= points.first && i <= points.last) {
            Zone& zone = samples_[i].zone;
            if (gone < zone_length)
                zone = Zone::outside;
            else if (zone != Zone::outside)
                zone = std::min(zone, ramp ? Zone::ramp : Zone::near_end);
        }
        if (k % stride_ == 0) {
            const float speed = samples_.speed(i);
            if (gone >= zone_length && !(speed > (1 + least_rise) * before)) ramp = false;
            before = speed;
        }
        if (k + 1 < count) gone += arc_length_.step(direction > 0 ? i : i - 1);
    }
}

}  // namespace clsurf
