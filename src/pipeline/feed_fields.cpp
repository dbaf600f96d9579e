#include "pipeline/feed_fields.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/error.h"
#include "core/not_finite.h"
#include "mapping/point_motions.h"

namespace clsurf {
namespace {

/// Feed of a motion; NaN: it has none.
float feed_of(const Motions& motions, std::int64_t motion) {
    const auto m = static_cast<std::size_t>(motion);
    return motion >= 0 && is_cut(motions.kind[m]) && motions.feed[m] > 0 ? motions.feed[m] : missing<float>;
}

}  // namespace

FieldInfo feed_share_info() {
    FieldInfo info{
        "feed_share", "Path speed as a share of the programmed feed", unit::percent, FieldScale::sequential, {}};
    info.preference = FieldPreference::higher;
    info.usual_range = ValueRange{0, 1};
    // An excess from overshoot or noise of positions does not count as a higher speed.
    info.slack = 0.05;
    info.report_rank = 1;
    return info;
}

double programmed_feed_at(const Part& part, PointIndex point) {
    return feed_of(part.program.motions, part.lines->motion_at(point));
}

std::vector<SpeedShares> speed_shares(const QualityReport& report, const Part& part) {
    std::vector<SpeedShares> shares;
    for (const Defect& defect : report.defects) {
        const double programmed = programmed_feed_at(part, defect.point);
        const double feed = programmed > 0 ? programmed : static_cast<double>(report.thresholds.usual_speed);
        shares.push_back({defect.speed / feed, defect.adjacent_speed / feed});
    }
    return shares;
}

std::vector<FieldInfo> FeedFields::fields() const { return {feed_share_info()}; }

bool FeedFields::can_compute(std::string_view) const {
    const Motions& motions = program_.motions;
    for (std::int64_t i = 0; i < motions.size(); ++i) {
        if (feed_of(motions, i) > 0) return true;
    }
    return false;
}

std::vector<Field> FeedFields::compute(std::span<const std::string_view> names, PointRange points) const {
    if (!can_compute(names.front())) throw UsageError("the field 'feed_share' needs a program with feeds: PROGRAM LOG");
    constexpr std::array<std::string_view, 1> speed{"speed"};
    Field field = std::move(positions_->compute(speed, points).front());
    const std::string note = field.info.note;
    field.info = feed_share_info();
    field.info.note = note;
    const Motions& motions = program_.motions;
    for_each_motion(*lines_, points, [&](PointIndex point, std::int64_t motion) {
        field.values[static_cast<std::size_t>(point - points.first)] /= feed_of(motions, motion);
    });
    return std::vector<Field>(names.size(), field);
}

}  // namespace clsurf
