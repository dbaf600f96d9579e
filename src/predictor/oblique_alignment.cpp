#include "predictor/oblique_alignment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/not_finite.h"
#include "predictor/compared.h"
#include "predictor/median_of.h"

namespace clsurf {
namespace {

// steepest, most_passes, oblique_corner_cosine: docs/design/predictor.md#1-compare-adjacent-passes, Oblique comparison.
constexpr float steepest = 1.5F;        ///< step-overs along the feed per pass: an edge at 34° to the feed
constexpr float sampled_every = 0.25F;  ///< step-overs
// Directions are 1.5/24 = 1/16 step-over apart, around the best one 1/128.
constexpr int tries = 24;                        ///< obliquities on either side of zero …
constexpr int halvings = 3;                      ///< … and how often their distance is halved around the best one
constexpr int most_passes = 3;                   ///< on either side
constexpr std::size_t fewest = 4;                ///< fewest passes if both sides have some …
constexpr std::size_t fewest_of_one_side = 3;    ///< … and at a border
constexpr float oblique_corner_cosine = 0.906F;  ///< cos 25°
constexpr float same_speed = 0.01F;              ///< share of the speed: smaller differences need no oblique comparison
constexpr float clearly_better = 0.5F;           ///< share of the disagreement straight across

/// A pass around a location: speeds at even distances along the feed of the examined point.
class Profile {
public:
    Profile(const ClSurface& surface, const Signals& signals, const AdjacentPlace& place, const Eigen::Vector3f& feed)
        : passes_(place.passes), spacing_(sampled_every * static_cast<float>(surface.step_over)) {
        const float reach = steepest * static_cast<float>(std::abs(place.passes) * surface.step_over);
        const auto samples = static_cast<std::size_t>(std::ceil(reach / spacing_)) + 1;
        const bool along = signals.feed(place.at.nearest()).dot(feed) > 0;
        for (const bool onwards : {true, false})
            walk(surface.positions, signals, place.at, along == onwards ? 1 : -1, samples, locations_[onwards ? 1 : 0]);
    }

    [[nodiscard]] int passes() const { return passes_; }
    /// The location nearest to `distance` [mm] along the feed; domain: speed() is known there.
    [[nodiscard]] const PathLocation& at(float distance) const {
        const std::vector<PathLocation>& side = locations_[distance >= 0 ? 1 : 0];
        return side[std::min(side.size() - 1, static_cast<std::size_t>(std::lround(std::abs(distance) / spacing_)))];
    }
    [[nodiscard]] float speed(const Signals& signals, float distance) const {
        const std::vector<PathLocation>& side = locations_[distance >= 0 ? 1 : 0];
        const float place = std::abs(distance) / spacing_;
        const auto k = static_cast<std::size_t>(place);
        if (k + 1 >= side.size()) return missing<float>;
        const float a = speed_at(signals, side[k]);
        return a + (place - static_cast<float>(k)) * (speed_at(signals, side[k + 1]) - a);
    }

    /// The values of the pass within the profile that are nearest to those of the point, each quantity by itself.
    [[nodiscard]] Compared nearest(const Signals& signals, const Compared& own, const Eigen::Vector3f& normal) const {
        Compared result = compared_at(signals, locations_[0].front(), normal);
        const auto take = [](float& best, float value, float wanted) {
            if (!(std::abs(best - wanted) <= std::abs(value - wanted))) best = value;
        };
        for (const std::vector<PathLocation>& side : locations_) {
            Compared before = compared_at(signals, side.front(), normal);
            for (const PathLocation& at : side) {
                const Compared there = compared_at(signals, at, normal);
                // Between two locations the pass takes all values between theirs.
                const auto passes_through = [&](float Compared::*value) {
                    return std::clamp(own.*value, std::min(before.*value, there.*value),
                                      std::max(before.*value, there.*value));
                };
                take(result.speed, passes_through(&Compared::speed), own.speed);
                take(result.relief, passes_through(&Compared::relief), own.relief);
                if ((there.acceleration - own.acceleration).squaredNorm() <
                    (result.acceleration - own.acceleration).squaredNorm())
                    result.acceleration = there.acceleration;
                before = there;
            }
        }
        return result;
    }

private:
    static float speed_at(const Signals& signals, const PathLocation& at) {
        return interpolate([&](PointIndex i) { return signals[i].speed; }, at);
    }

    /// Places `spacing_` apart, from one on, as long as the pass is judged.
    void walk(const Positions& p, const Signals& signals, const PathLocation& from, int direction, std::size_t samples,
              std::vector<PathLocation>& out) const {
        out.push_back(from);
        PointIndex next = direction > 0 ? from.point + 1 : from.fraction > 0 ? from.point : from.point - 1;
        Eigen::Vector3f here = position_at(p, from);
        float left = spacing_;  // to the next location
        while (out.size() < samples && next >= 0 && next < p.size() && signals[next].zone != Zone::outside) {
            const Eigen::Vector3f step = p[next] - here;
            const float length = step.norm();
            if (!(length == length)) return;
            if (length < left) {
                left -= length;
                here = p[next];
                next += direction;
                continue;
            }
            here += step * (left / length);
            left = spacing_;
            const PointIndex before = next - direction;
            const float whole = (p[next] - p[before]).norm();
            const float share = whole > 0 ? std::min(1.0F, (here - p[before]).norm() / whole) : 0.0F;
            out.push_back(direction > 0 ? PathLocation{before, share} : PathLocation{next, 1 - share});
        }
    }

    int passes_;
    float spacing_;
    std::array<std::vector<PathLocation>, 2> locations_;  ///< against the feed and along it, from the location on
};

/// Median speed of the passes at an obliquity [mm along the feed per pass], and the sum of the deviations from it.
struct Agreement {
    float speed = missing<float>;
    float disagreement = std::numeric_limits<float>::infinity();
};
Agreement agreement(const Signals& signals, std::span<const Profile> profiles, float obliquity) {
    std::array<float, 2 * most_passes> values;
    std::size_t count = 0;
    for (const Profile& profile : profiles) {
        const float speed = profile.speed(signals, obliquity * static_cast<float>(profile.passes()));
        if (speed != speed) return {};
        values[count++] = speed;
    }
    const std::span<const float> there(values.data(), count);
    Agreement result{median_of(there, 1, [](float value) { return value; }), 0};
    for (const float value : there) result.disagreement += std::abs(value - result.speed);
    return result;
}

/// Whether the passes hardly differ straight across the feed.
bool agree_straight(const Signals& signals, std::span<const AdjacentPlace> places) {
    const auto [low, high] =
        std::minmax_element(places.begin(), places.end(), [&](const AdjacentPlace& a, const AdjacentPlace& b) {
            return signals[a.at.nearest()].speed < signals[b.at.nearest()].speed;
        });
    return signals[high->at.nearest()].speed - signals[low->at.nearest()].speed <
           same_speed * signals[high->at.nearest()].speed;
}

/// The medians of the passes, and the steps to those adjacent to the point. `value(profile)`: the values of a pass.
template <typename F>
ObliqueComparison summarise(const Compared& own, std::span<const Profile> profiles, F&& value) {
    std::array<Compared, 2 * most_passes> places;
    ObliqueComparison result;
    for (std::size_t k = 0; k < profiles.size(); ++k) {
        const Compared& there = places[k] = value(profiles[k]);
        if (std::abs(profiles[k].passes()) != 1) continue;
        result.speed_step = std::max(result.speed_step, std::abs(own.speed - there.speed));
        result.acceleration_step = std::max(result.acceleration_step, (own.acceleration - there.acceleration).norm());
        result.relief_step = std::max(result.relief_step, std::abs(own.relief - there.relief));
    }
    const std::span<const Compared> there(places.data(), profiles.size());
    result.speed = median_of(there, 1, [](const Compared& c) { return c.speed; });
    result.relief = median_of(there, 1, [](const Compared& c) { return c.relief; });
    for (Eigen::Index axis = 0; axis < 3; ++axis)
        result.acceleration[axis] = median_of(there, 1, [axis](const Compared& c) { return c.acceleration[axis]; });
    return result;
}

}  // namespace

bool turns_on_surface(const ClSurface& surface, const Signals& signals, PointIndex point) {
    const Eigen::Vector3f normal = signals.normal(point);
    const Positions& p = surface.positions;
    const auto step_over = static_cast<float>(surface.step_over);
    const auto along_surface = [&](PointIndex i) {
        const Eigen::Vector3f feed = signals.feed(i);
        return Eigen::Vector3f(feed - feed.dot(normal) * normal);
    };
    const Eigen::Vector3f here = along_surface(point);
    for (const PointIndex step : {-1, 1}) {
        float arc_length = 0, looked = 0;
        for (PointIndex i = point + step;
             i >= 0 && i < p.size() && signals[i].zone != Zone::outside && arc_length < steepest * step_over;
             i += step) {
            arc_length += (p[i] - p[i - step]).norm();
            if (arc_length < looked) continue;
            looked = arc_length + sampled_every * step_over;
            const Eigen::Vector3f there = along_surface(i);
            const float dot = there.dot(here);
            if (dot < 0 ||
                dot * dot < oblique_corner_cosine * oblique_corner_cosine * there.squaredNorm() * here.squaredNorm())
                return true;
        }
    }
    return false;
}

std::optional<ObliqueComparison> compare_obliquely(const ClSurface& surface, const Signals& signals,
                                                   const PathLocation& here, std::span<const AdjacentPlace> places) {
    if (places.empty()) return std::nullopt;
    const PointIndex point = here.nearest();
    const Eigen::Vector3f feed = signals.feed(point);
    const Eigen::Vector3f normal = signals.normal(point);
    const Compared own = compared_at(signals, here, normal);
    const bool corner = turns_on_surface(surface, signals, point);
    const bool one_sided = places.front().passes * places.back().passes > 0;
    if (!corner && (places.size() < (one_sided ? fewest_of_one_side : fewest) || agree_straight(signals, places)))
        return std::nullopt;
    std::vector<Profile> profiles;
    profiles.reserve(places.size());
    for (const AdjacentPlace& place : places) profiles.emplace_back(surface, signals, place, feed);
    if (corner) {
        // In a corner no obliquity fits: along any straight line across it, some passes are on the straight, some in the bend.
        ObliqueComparison result =
            summarise(own, profiles, [&](const Profile& profile) { return profile.nearest(signals, own, normal); });
        result.corner = true;
        return result;
    }
    const Agreement straight = agreement(signals, profiles, 0);
    Agreement best = straight;
    float obliquity = 0;
    const auto consider = [&](float tried) {
        const Agreement there = agreement(signals, profiles, tried);
        if (!(there.disagreement < best.disagreement)) return;
        best = there;
        obliquity = tried;
    };
    float apart = steepest * static_cast<float>(surface.step_over) / tries;
    for (int k = -tries; k <= tries; ++k) consider(apart * static_cast<float>(k));
    for (int k = 0; k < halvings; ++k) {
        apart *= 0.5F;
        const float middle = obliquity;
        consider(middle - apart);
        consider(middle + apart);
    }
    if (!(best.disagreement < clearly_better * straight.disagreement)) return std::nullopt;

    return summarise(own, profiles, [&](const Profile& profile) {
        return compared_at(signals, profile.at(obliquity * static_cast<float>(profile.passes())), normal);
    });
}

}  // namespace clsurf
