#include "predictor/bend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace clsurf {
namespace {

// bend_cosine, slight_cosine, own_share, long_link, link_nearest, own_turn, accelerates, link_accelerates, accelerates_more,
// longest_braking and those that begin with closing: docs/design/predictor.md#4-join-places-into-defects, Bends. Logs with
// islands, links and triangles test them (docs/experiments/predictor.md#kinds-of-logs-that-were-not-used-for-development).
constexpr float bend_cosine = 0.906F;  ///< cos 25°: the path bends if it turns by more than this …
constexpr float net_reach =
    2;  ///< … and is still turned so many step-overs away on both sides, unlike at a step-over move
constexpr float slight_cosine = 0.996F;   ///< cos 5°: enough if the adjacent passes …
constexpr float own_share = 0.7F;         ///< … turn by less than this share of its turn
constexpr float adjacent_spacing = 0.5F;  ///< step-overs between the places where these are examined
constexpr float turn_reach = 1;           ///< step-overs on either side, over which a turn is measured
/// Step-overs on either side, within which a link leads to the next pass. A long slanting link is detected over the longest
/// of them. In a curve the runs turn against each other over that length, so a short link is detected over a shorter length.
constexpr std::array link_reaches{5.0F, 3.0F, 2.0F};
constexpr float link_cosine = 0.94F;      ///< cos 20°: the runs that a link joins turn less against each other …
constexpr float link_aside = 0.6F;        ///< … and are so many step-overs apart
constexpr float link_sine = 0.24F;        ///< sin 14°: least angle between the link and these runs
constexpr float closing_reach = 5;        ///< step-overs on either side, within which a loop closes …
constexpr float closing_nearest = 0.5F;   ///< … if the distance to the adjacent pass falls below this …
constexpr float closing_farthest = 0.8F;  ///< … and exceeds this before or after it [step-overs]
constexpr float long_link = 20;           ///< step-overs: longest link …
constexpr float link_nearest = 0.65F;     ///< … which comes this near to one of the adjacent passes [step-overs] …
constexpr float own_turn = 0.035F;      ///< … and turns at either corner by 2° more or less than the adjacent passes
constexpr float adjacent_reach = 1.5F;  ///< step-overs along the feed: farthest bend of an adjacent pass
constexpr float look_every = 0.1F;      ///< step-overs between examined points
constexpr float accelerates = 0.35F;    ///< least share of the usual acceleration, which jerk limits and windows reduce
constexpr float link_accelerates = 0.15F;  ///< the same at a link, whose two corners share the turn
// ramp_share: docs/design/predictor.md#limits-of-the-method, a fifth of the usual acceleration.
constexpr float ramp_share = 0.2F;         ///< the same along the path, between the bend and the end of its ramp
constexpr float accelerates_more = 1.35F;  ///< ratio of accelerations if a bend is taken 16 % faster; 1.16²
constexpr float rises_again = 1.03F;       ///< times the least speed: above it, another slow place begins
/// [s] No mill needs longer to brake for a bend. This limits the search in logs with hardly any acceleration.
constexpr float longest_braking = 0.5F;
constexpr float hardly_slower = 0.5F;  ///< share of the threshold

}  // namespace

Bends::Bends(const ClSurface& surface, const Signals& signals, const Thresholds& thresholds)
    : surface_(surface),
      signals_(signals),
      thresholds_(thresholds),
      step_over_(static_cast<float>(surface.step_over)) {}

bool Bends::explain(PointIndex point, const Comparison& comparison) const {
    constexpr std::size_t q = index_of(Quantity::speed);
    const float residual = comparison.residual[q], slight = hardly_slower * thresholds_.of[q];
    const std::array<PathLocation, 2> sides{comparison.adjacent_left, comparison.adjacent_right};
    if (residual < -slight) return slows_for_bend(point);
    if (!(residual > slight)) {  // only the accelerations differ
        return slows_for_bend(point) || std::any_of(sides.begin(), sides.end(), [&](const PathLocation& at) {
                   return at.exists() && slows_for_bend(at.nearest());
               });
    }
    const float least = signals_[point].speed * (1 - slight);
    int explained = 0;
    for (const PathLocation& at : sides) {
        if (!at.exists() || !(signals_[at.nearest()].speed < least)) continue;
        if (!slows_for_bend(at.nearest())) return false;
        ++explained;
    }
    return explained > 0;
}

PointIndex Bends::stride_at(PointIndex point) const {
    const PointIndex other = point > 0 ? point - 1 : point + 1;
    const float record = (surface_.positions[point] - surface_.positions[other]).norm();
    return record > 0 ? std::clamp<PointIndex>(std::lround(look_every * step_over_ / record), 1, 512) : 1;
}

/// The point of the pass at a distance [mm], or the last one before the end of the pass.
PointIndex Bends::at_distance(PointIndex from, int direction, float distance) const {
    const PointIndex stride = stride_at(from);
    float arc_length = 0;
    PointIndex at = from;
    while (arc_length < distance) {
        const PointIndex next = at + direction * stride;
        if (next < 0 || next >= signals_.size() || !(signals_[next].speed > 0)) break;
        const float step = (surface_.positions[next] - surface_.positions[at]).norm();
        if (!(step >= 0)) break;
        arc_length += step + look_every * look_every * step_over_;  // so that the search ends if the tool rests
        at = next;
    }
    return at;
}

Bends::Turn Bends::turn_at(PointIndex point) const {
    Eigen::Vector3f normal = signals_.normal(point);
    if (!normal.allFinite()) normal.setZero();  // a tip may have no adjacent pass: its turn is measured in space
    const auto along_surface = [&](PointIndex i) {
        const Eigen::Vector3f feed = signals_.feed(i);
        return Eigen::Vector3f((feed - feed.dot(normal) * normal).normalized());
    };
    Turn turn;
    for (const float share : {0.25F, 0.5F, 1.0F}) {
        const float reach = share * turn_reach * step_over_;
        const PointIndex before = at_distance(point, -1, reach), after = at_distance(point, +1, reach);
        const float cosine = along_surface(before).dot(along_surface(after));
        const float arc = (surface_.positions[point] - surface_.positions[before]).norm() +
                          (surface_.positions[after] - surface_.positions[point]).norm();
        if (!(cosine == cosine) || !(arc > 0)) continue;
        const float speed = signals_[point].speed;
        turn.acceleration =
            std::max(turn.acceleration, speed * speed * std::acos(std::clamp(cosine, -1.0F, 1.0F)) / arc);
        turn.cosine = cosine;
    }
    const PointIndex before = at_distance(point, -1, net_reach * step_over_);
    const PointIndex after = at_distance(point, +1, net_reach * step_over_);
    turn.cosine = std::max(turn.cosine, along_surface(before).dot(along_surface(after)));
    return turn;
}

/// Whether an adjacent pass takes a similar bend faster.
bool Bends::is_faster_on_adjacent(PointIndex bend, const Turn& turn) const {
    for (const Side side : {Side::left, Side::right}) {
        const PathLocation at = adjacent_location(surface_, {bend, 0}, signals_.feed(bend), side);
        if (!at.exists() || signals_[at.nearest()].zone == Zone::outside) continue;
        PointIndex slowest = at.nearest();
        for (const int direction : {-1, 1}) {
            const PointIndex end = at_distance(at.nearest(), direction, adjacent_reach * step_over_);
            for (PointIndex i = at.nearest(); i != end; i += direction) {
                if (signals_[i].speed < signals_[slowest].speed) slowest = i;
            }
        }
        const Turn there = turn_at(slowest);
        if (there.cosine < bend_cosine && there.acceleration > accelerates_more * turn.acceleration) return true;
    }
    return false;
}

/// Whether the adjacent passes hardly turn there: only this pass has the bend, as at either end of a long link.
bool Bends::turns_alone(PointIndex bend, const Turn& turn) const {
    const float slight = std::acos(turn.cosine) * own_share;
    bool any_adjacent = false;
    for (const Side side : {Side::left, Side::right}) {
        const PathLocation at = adjacent_location(surface_, {bend, 0}, signals_.feed(bend), side);
        if (!at.exists() || signals_[at.nearest()].zone == Zone::outside) continue;
        any_adjacent = true;
        for (float along = -adjacent_reach; along <= adjacent_reach; along += adjacent_spacing) {
            const PointIndex there = at_distance(at.nearest(), along < 0 ? -1 : 1, std::abs(along) * step_over_);
            if (std::acos(std::min(turn_at(there).cosine, 1.0F)) > slight) return false;
        }
    }
    return any_adjacent;
}

bool Bends::is_link(PointIndex point) const {
    return std::any_of(link_reaches.begin(), link_reaches.end(),
                       [&](float reach) { return leads_aside(point, reach * step_over_); });
}

bool Bends::leads_aside(PointIndex point, float reach) const {
    const Positions& p = surface_.positions;
    const PointIndex before = at_distance(point, -1, reach);
    const PointIndex after = at_distance(point, +1, reach);
    const Eigen::Vector3f in = signals_.feed(before), out = signals_.feed(after);
    if (!(in.dot(out) > link_cosine)) return false;
    const Eigen::Vector3f along = (in + out).normalized(), chord = p[after] - p[before];
    const Eigen::Vector3f aside = chord - chord.dot(along) * along;
    if (!(aside.norm() > link_aside * step_over_)) return false;
    const Eigen::Vector3f sideways = aside.normalized();
    float steepest = 0;  // compared with a path that turns evenly from one run to the other
    for (PointIndex i = before; i <= after; ++i) {
        const float share = static_cast<float>(i - before) / static_cast<float>(after - before);
        const float even = (in + share * (out - in)).dot(sideways);
        steepest = std::max(steepest, signals_.feed(i).dot(sideways) - even);
    }
    return steepest > link_sine;
}

float Bends::adjacent_distance(PointIndex point) const {
    float nearest = std::numeric_limits<float>::infinity();
    const Eigen::Vector3f feed = signals_.feed(point);
    for (const Side side : {Side::left, Side::right}) {
        const PathLocation at = adjacent_location(surface_, {point, 0}, feed, side);
        if (!at.exists()) continue;
        nearest = std::min(nearest, (position_at(surface_.positions, at) - surface_.positions[point]).norm());
    }
    return nearest;
}

bool Bends::closes_loop(PointIndex point) const {
    const float reach = closing_reach * step_over_;
    return distance_falls(at_distance(point, -1, reach), at_distance(point, +1, reach), closing_nearest);
}

float Bends::turn_difference(PointIndex point) const {
    const float reach = net_reach * step_over_;
    const auto turn = [&](PointIndex at) {
        return Eigen::Vector3f(signals_.feed(at_distance(at, +1, reach)) - signals_.feed(at_distance(at, -1, reach)));
    };
    const Eigen::Vector3f own = turn(point);
    float least = std::numeric_limits<float>::infinity();
    for (const Side side : {Side::left, Side::right}) {
        const PathLocation at = adjacent_location(surface_, {point, 0}, signals_.feed(point), side);
        if (!at.exists()) continue;
        // A pass in the opposite direction also turns in the opposite direction: the difference of its feeds is the same.
        const float other = (own - turn(at.nearest())).norm();
        if (other == other) least = std::min(least, other);
    }
    return std::isfinite(least) ? least : 0;
}

bool Bends::is_corner_of_long_link(PointIndex point) const {
    if (!(turn_difference(point) > own_turn)) return false;
    const float reach = long_link * step_over_, room = closing_reach * step_over_;
    return distance_falls(at_distance(point, -1, reach), at_distance(point, +1, room), link_nearest) ||
           distance_falls(at_distance(point, -1, room), at_distance(point, +1, reach), link_nearest);
}

bool Bends::distance_falls(PointIndex first, PointIndex last, float below) const {
    const PointIndex stride = stride_at(first);
    float nearest = std::numeric_limits<float>::infinity(), farthest = 0;
    for (PointIndex i = first; i <= last; i += stride) {
        const float distance = adjacent_distance(i);
        if (!(distance < closing_reach * step_over_)) continue;
        nearest = std::min(nearest, distance);
        farthest = std::max(farthest, distance);
    }
    return nearest < below * step_over_ && farthest > closing_farthest * step_over_;
}

bool Bends::is_bend(PointIndex point) const {
    if (closes_loop(point)) return true;
    const Turn turn = turn_at(point);
    const float usual = thresholds_.usual_acceleration;
    if (turn.acceleration >= link_accelerates * usual && (is_link(point) || is_corner_of_long_link(point))) return true;
    if (!(turn.acceleration >= accelerates * usual)) return false;
    if (turn.cosine < bend_cosine) return !is_faster_on_adjacent(point, turn);
    return turn.cosine < slight_cosine && turns_alone(point, turn);
}

/// The point up to which the speed falls continuously; nullopt if the speed changes by less than the usual acceleration allows.
std::optional<PointIndex> Bends::slowest_ahead(PointIndex point, int direction) const {
    const float a = 2 * accelerates * thresholds_.usual_acceleration;
    const float speed = signals_[point].speed;
    const PointIndex stride = stride_at(point);
    PointIndex slowest = point, at = point;
    const float reach = std::min(speed * speed / a + net_reach * step_over_, speed * longest_braking);
    float arc_length = 0, arc_length_to_slowest = 0;
    while (arc_length < reach) {
        const PointIndex next = at + direction * stride;
        if (next < 0 || next >= signals_.size() || !(signals_[next].speed > 0)) break;
        arc_length += (surface_.positions[next] - surface_.positions[at]).norm() + look_every * look_every * step_over_;
        at = next;
        const float least = signals_[slowest].speed, there = signals_[at].speed;
        if (there < least) {
            slowest = at;
            arc_length_to_slowest = arc_length;
        } else if (!(there <= rises_again * least)) {
            break;
        }
    }
    const float least = signals_[slowest].speed;
    const float ramp = std::max(0.0F, arc_length_to_slowest - turn_reach * step_over_);
    if (speed * speed < least * least + a * ramp) return std::nullopt;
    return slowest;
}

bool Bends::slows_for_bend(PointIndex point) const {
    for (const int direction : {-1, 1}) {
        const std::optional<PointIndex> slowest = slowest_ahead(point, direction);
        if (!slowest) continue;
        const float distance = (surface_.positions[*slowest] - surface_.positions[point]).norm();
        const bool ramp = std::abs(signals_.acceleration(point).dot(signals_.feed(point))) >=
                          ramp_share * thresholds_.usual_acceleration;
        if ((ramp || distance < adjacent_reach * step_over_) && is_bend(*slowest)) return true;
    }
    return false;
}

}  // namespace clsurf
