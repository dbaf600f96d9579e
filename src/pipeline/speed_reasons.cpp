#include "pipeline/speed_reasons.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/block.h"
#include "core/units.h"
#include "pipeline/channel_classes.h"
#include "pipeline/feed_fields.h"
#include "pipeline/limits_of.h"

namespace clsurf {
namespace {

constexpr double slow = 0.95;               ///< share of the programmed feed
constexpr double short_block_time = 0.01;   ///< [s] at the programmed feed
constexpr std::int64_t blocks_nearby = 10;  ///< to each side
constexpr double least_turn = 20;           ///< [deg]
constexpr double corner_time = 0.02;        ///< [s] at the programmed feed: range of corners before and after a point
constexpr double least_share = 0.9;         ///< share of a limit
constexpr PointIndex points_at_once = 16 * block_points;  ///< points whose shares are in memory at once

/// The reasons from the channels `limit` and `override`.
class LogReasons {
public:
    explicit LogReasons(const Log& log) : limit_(log.find("limit")), override_(log.find("override")) {
        if (limit_ == nullptr) return;
        for (ChannelClasses& known : channel_classes()) {
            if (known.channel == limit_->name) factors_ = std::move(known.classes);
        }
    }

    [[nodiscard]] bool has_override() const { return override_ != nullptr; }
    [[nodiscard]] std::optional<std::string> named_limit(PointIndex point) const {
        if (limit_ == nullptr) return std::nullopt;
        const auto value = static_cast<float>(limit_->values.at(point));
        for (const FieldClass& factor : factors_) {
            if (factor.value == value && !factor.good) return "limited by: " + factor.name;
        }
        return std::nullopt;
    }
    [[nodiscard]] std::optional<std::string> override_below_full(PointIndex point) const {
        if (override_ == nullptr) return std::nullopt;
        const double percent = override_->values.at(point);
        if (!(percent < 100)) return std::nullopt;
        return fmt::format("feed override {:.0f} %", percent);
    }

private:
    const Channel* limit_;
    const Channel* override_;
    std::vector<FieldClass> factors_;
};

/// The shares of the limits that each axis uses.
class AxisShares {
public:
    explicit AxisShares(const Part& part) {
        if (part.limits.empty()) return;
        fields_ = limit_fields(part);
        for (const std::string_view quantity : {"speed", "acceleration", "jerk"}) {
            for (const char axis : {'x', 'y', 'z', 'a', 'b', 'c'}) {
                const std::string name = fmt::format("{}_share.{}", quantity, axis);
                if (!fields_->can_compute(name)) continue;
                names_.push_back(name);
                words_.push_back(fmt::format("{} of {}", quantity, static_cast<char>(axis - 'a' + 'A')));
            }
        }
    }

    /// Computes the shares at some points, for nearest().
    void read(PointRange points) {
        if (names_.empty() || points.size() == 0) return;
        first_ = points.first;
        shares_ = fields_->compute(std::vector<std::string_view>(names_.begin(), names_.end()), points);
    }
    /// The axis that is nearest to a limit or above it.
    [[nodiscard]] std::optional<std::string> nearest(PointIndex point) const {
        double most = least_share;
        std::optional<std::size_t> found;
        for (std::size_t k = 0; k < shares_.size(); ++k) {
            const double share = shares_[k].values[static_cast<std::size_t>(point - first_)];
            if (!(share >= most)) continue;
            most = share;
            found = k;
        }
        if (!found) return std::nullopt;
        return fmt::format("{} at {:.0f} % of its limit", words_[*found], 100 * most);
    }

private:
    std::shared_ptr<const LimitFields> fields_;
    std::vector<std::string> names_, words_;
    PointIndex first_ = 0;
    std::vector<Field> shares_;  ///< of the points that were read
};

/// The motions around a motion, and the corners between them.
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

    /// The sharpest corner that is near enough to require braking.
    [[nodiscard]] std::optional<std::string> corner() const {
        double sharpest = least_turn;
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

/// The programmed feed at a point [mm/s] if the tool is slower than that; nullopt: it is not.
std::optional<double> feed_above(const Part& part, PointIndex point, double speed) {
    const double feed = programmed_feed_at(part, point);
    return speed < slow * feed ? std::optional(feed) : std::nullopt;
}

/// All reasons for a slow point, the most certain first.
std::vector<std::string> reasons_at(const Part& part, PointIndex point, double feed, const LogReasons& log,
                                    const AxisShares& shares) {
    std::vector<std::string> reasons;
    const auto add = [&](std::optional<std::string> reason) {
        if (reason) reasons.push_back(std::move(*reason));
    };
    const BlocksNearby blocks(part.program.motions, part.lines->motion_at(point), feed);
    add(log.named_limit(point));
    add(log.override_below_full(point));
    add(blocks.short_blocks());
    add(blocks.corner());
    add(shares.nearest(point));
    if (reasons.empty())
        reasons.emplace_back(log.has_override()
                                 ? "nothing in program and log explains it: a ramp or a feed hold?"
                                 : "nothing in program and log explains it: a ramp, a feed override or a feed hold?");
    return reasons;
}

/// The text of words_of() after the speed: "of F3000 mm/min", ": blocks of 0.02 mm", "; a corner of 35° before line 12".
std::vector<std::string> pieces_of(const SpeedReasons& why) {
    std::vector<std::string> pieces{fmt::format("of F{:.0f} mm/min", why.programmed_feed * seconds_per_minute)};
    for (const std::string& reason : why.reasons) pieces.push_back((pieces.size() == 1 ? ": " : "; ") + reason);
    return pieces;
}

/// The range from the first to the last slow one of these points; empty: there is none.
PointRange slow_range(const Part& part, std::span<const PointIndex> points, std::span<const float> speeds) {
    PointRange range{0, -1};
    for (const PointIndex point : points) {
        if (!feed_above(part, point, speeds[static_cast<std::size_t>(point)])) continue;
        if (range.size() == 0) range.first = point;
        range.last = point;
    }
    return range;
}

}  // namespace

SpeedReasons speed_reasons(const Part& part, PointIndex point, double speed) {
    SpeedReasons result{programmed_feed_at(part, point), {}};
    if (!feed_above(part, point, speed)) return result;
    AxisShares shares(part);
    shares.read({point, point});
    result.reasons = reasons_at(part, point, result.programmed_feed, LogReasons(part.log), shares);
    return result;
}

std::string words_of(const SpeedReasons& why, double speed) {
    if (why.reasons.empty()) return {};
    return fmt::format("{:.0f} {}", speed * seconds_per_minute, fmt::join(pieces_of(why), ""));
}

SlowWords slow_words(const Part& part, std::span<const PointIndex> points, std::span<const float> speeds) {
    SlowWords all;
    if (speeds.empty()) return all;
    std::int64_t rounded = 0;
    std::unordered_map<std::string, std::uint32_t> known;
    const LogReasons log(part.log);
    AxisShares shares(part);
    for (std::size_t first = 0; first < points.size();) {
        std::size_t end = first;
        while (end < points.size() && points[end] - points[first] < points_at_once) ++end;
        shares.read(slow_range(part, points.subspan(first, end - first), speeds));
        std::vector<std::vector<std::string>> pieces(end - first);
        parallel_for(static_cast<std::int64_t>(pieces.size()), block_points, [&](std::int64_t from, std::int64_t to) {
            for (auto k = static_cast<std::size_t>(from); k < static_cast<std::size_t>(to); ++k) {
                const PointIndex point = points[first + k];
                const std::optional<double> feed = feed_above(part, point, speeds[static_cast<std::size_t>(point)]);
                if (feed) pieces[k] = pieces_of({*feed, reasons_at(part, point, *feed, log, shares)});
            }
        });
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            const double speed = speeds[static_cast<std::size_t>(points[first + k])];
            if (!pieces[k].empty()) rounded = std::llrint(speed * seconds_per_minute);  // rounds like fmt
            all.speeds.push_back(rounded);
            for (std::size_t c = 0; c < pieces[k].size(); ++c) {
                const auto [piece, is_new] =
                    known.try_emplace(pieces[k][c], static_cast<std::uint32_t>(all.pieces.size()));
                if (is_new) all.pieces.push_back(pieces[k][c]);
                if (c == all.columns.size()) all.columns.emplace_back(points.size(), 0U);
                all.columns[c][first + k] = piece->second;
            }
        }
        first = end;
    }
    return all;
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
