#include "pipeline/speed_reasons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/units.h"
#include "pipeline/channel_classes.h"
#include "pipeline/feed_fields.h"
#include "pipeline/limits_of.h"

namespace clsurf {
namespace {

constexpr double slow = 0.95;               ///< of the programmed feed
constexpr double short_block_time = 0.01;   ///< [s] at the programmed feed
constexpr std::int64_t blocks_nearby = 10;  ///< to each side
constexpr double least_corner = 20;         ///< [deg]
constexpr double corner_time = 0.02;  ///< [s] at the programmed feed: as far ahead and behind a corner is looked for
constexpr double least_share = 0.9;   ///< of a limit

/// What the channel `limit` says.
std::optional<std::string> named_limit(const Part& part, PointIndex point) {
    const Channel* channel = part.log.find("limit");
    if (channel == nullptr) return std::nullopt;
    const auto value = static_cast<float>(channel->values.at(point));
    for (const ChannelClasses& known : channel_classes()) {
        if (known.channel != channel->name) continue;
        for (const FieldClass& factor : known.classes) {
            if (factor.value == value && !factor.good) return "limited by: " + factor.name;
        }
    }
    return std::nullopt;
}

std::optional<std::string> override_below_full(const Part& part, PointIndex point) {
    const Channel* channel = part.log.find("override");
    if (channel == nullptr) return std::nullopt;
    const double percent = channel->values.at(point);
    if (!(percent < 100)) return std::nullopt;
    return fmt::format("feed override {:.0f} %", percent);
}

/// The axis that is nearest to a limit, or beyond it.
std::optional<std::string> nearest_limit(const Part& part, PointIndex point) {
    if (part.limits.empty()) return std::nullopt;
    const std::shared_ptr<const LimitFields> fields = limit_fields(part);
    double most = least_share;
    std::optional<std::string> words;
    for (const std::string_view quantity : {"speed", "acceleration", "jerk"}) {
        for (const char axis : {'x', 'y', 'z', 'a', 'b', 'c'}) {
            const std::string name = fmt::format("{}_share.{}", quantity, axis);
            if (!fields->can_compute(name)) continue;
            const std::array<std::string_view, 1> names{name};
            const double share = fields->compute(names, {point, point}).front().values[0];
            if (!(share >= most)) continue;
            most = share;
            words = fmt::format("{} of {} at {:.0f} % of its limit", quantity, static_cast<char>(axis - 'a' + 'A'),
                                100 * share);
        }
    }
    return words;
}

/// The motions round one, and where the tool turns between them.
class BlocksNearby {
public:
    BlocksNearby(const Motions& motions, std::int64_t motion, double feed)
        : motions_(motions), motion_(motion), feed_(feed) {}

    [[nodiscard]] std::optional<std::string> short_blocks() const {
        std::vector<double> lengths;
        for (std::int64_t i = motion_ - blocks_nearby; i <= motion_ + blocks_nearby; ++i) {
            if (is_straight(i)) lengths.push_back(direction(i).norm());
        }
        if (lengths.empty()) return std::nullopt;
        std::nth_element(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2),
                         lengths.end());
        const double median = lengths[lengths.size() / 2];
        if (!(median < short_block_time * feed_)) return std::nullopt;
        return fmt::format("blocks of {:.2g} mm, {:.2g} ms each at the programmed feed", median, 1000 * median / feed_);
    }

    /// The sharpest corner that is near enough to brake for.
    [[nodiscard]] std::optional<std::string> corner() const {
        double sharpest = least_corner;
        std::int64_t found = -1;
        for (const int step : {-1, 1}) {
            double gone = 0;
            for (std::int64_t i = step > 0 ? motion_ : motion_ - 1; gone < corner_time * feed_; i += step) {
                if (!is_straight(i) || !is_straight(i + 1)) break;
                const double angle = angle_between(direction(i), direction(i + 1)) * deg_per_rad;
                if (angle > sharpest) {
                    sharpest = angle;
                    found = i + 1;
                }
                gone += direction(step > 0 ? i + 1 : i).norm();
            }
        }
        if (found < 0) return std::nullopt;
        return fmt::format("a corner of {:.0f}° before line {}", sharpest,
                           motions_.line[static_cast<std::size_t>(found)]);
    }

private:
    [[nodiscard]] bool is_straight(std::int64_t i) const {
        return i > 0 && i < motions_.size() && motions_.kind[static_cast<std::size_t>(i)] == MotionKind::feed &&
               direction(i).norm() > 0;
    }
    [[nodiscard]] Vec3 direction(std::int64_t i) const {
        const Xyz& from = motions_.begin_of(i);
        const Xyz& to = motions_.end[static_cast<std::size_t>(i)];
        return {to.x - from.x, to.y - from.y, to.z - from.z};
    }

    const Motions& motions_;
    std::int64_t motion_;
    double feed_;
};

}  // namespace

SpeedReasons speed_reasons(const Part& part, PointIndex point, double speed) {
    SpeedReasons result{programmed_feed_at(part, point), {}};
    if (!(speed < slow * result.programmed_feed)) return result;
    const auto add = [&](std::optional<std::string> reason) {
        if (reason) result.reasons.push_back(std::move(*reason));
    };
    const BlocksNearby blocks(part.program.motions, part.lines->motion_at(point), result.programmed_feed);
    add(named_limit(part, point));
    add(override_below_full(part, point));
    add(blocks.short_blocks());
    add(blocks.corner());
    add(nearest_limit(part, point));
    if (result.reasons.empty())
        result.reasons.push_back(part.log.find("override") == nullptr
                                     ? "nothing in program and log explains it: a ramp, a feed override or a feed hold?"
                                     : "nothing in program and log explains it: a ramp or a feed hold?");
    return result;
}

std::string words_of(const SpeedReasons& why, double speed) {
    if (why.reasons.empty()) return {};
    return fmt::format("{:.0f} of F{:.0f} mm/min: {}", speed * seconds_per_minute,
                       why.programmed_feed * seconds_per_minute, fmt::join(why.reasons, "; "));
}

std::string slow_points(const std::vector<PointIndex>& points, const Part& part, const FieldSet& fields) {
    std::string text;
    for (const PointIndex point : points) {
        const double speed = fields.get_all({"speed"}, {point, point}).front().values[0];
        const std::string words = words_of(speed_reasons(part, point, speed), speed);
        if (!words.empty()) text += fmt::format("{}point {}: {}", text.empty() ? "slow at " : "; ", point, words);
    }
    return text;
}

}  // namespace clsurf
