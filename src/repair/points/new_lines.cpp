#include "repair/points/new_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "numeric/polyline.h"

namespace clsurf {
namespace {

constexpr std::size_t reach_of_bends = 5;  ///< aligned points to both sides whose bends determine the length of a line
constexpr double most_doublings = 6;       ///< of a part
// Planners that put arcs into corners stop at lines much shorter than their neighbours: docs/optimize.md#method, step 4.
constexpr double short_share = 0.5;  ///< share of both adjacent lines: shorter lines are dropped

class NewLines {
public:
    NewLines(const OldSegment& old, const SmoothSegment& curve, const std::vector<AlignedPoint>& aligned_points,
             const LineRules& rules, const TurningSegment* turning)
        : old_(old), curve_(curve), aligned_points_(aligned_points), rules_(rules), turning_(turning) {}

    std::vector<NewPlace> run() {
        const std::vector<std::uint8_t> kept = chosen();
        std::size_t from = 0;
        for (std::size_t k = 1; k < kept.size(); ++k) {
            if (kept[k] == 0) continue;
            join(from, k);
            from = k;
        }
        ends_.back() = {old_.length(), old_.points.back()};
        drop_short_lines();
        return std::move(ends_);
    }

private:
    /// The points of the curve that lines need to stay within the chord error.
    [[nodiscard]] std::vector<std::uint8_t> chosen() const {
        const std::size_t n = curve_.points.size();
        std::vector<std::uint8_t> kept(n, 1);
        std::vector<double> bend(n, 0);
        for (std::size_t k = 1; k + 1 < n; ++k)
            bend[k] = three_point_curvature(curve_.points[k - 1], curve_.points[k], curve_.points[k + 1]);
        for (std::size_t k = 1; k + 1 < n; ++k) {
            double most = 0;
            const std::size_t first = k > reach_of_bends ? k - reach_of_bends : 0,
                              last = std::min(k + reach_of_bends, n - 1);
            for (std::size_t j = first; j <= last; ++j) most = std::max(most, bend[j]);
            const double wanted =
                most > 0 ? std::min(std::sqrt(8 * rules_.chord_error / most), rules_.usual) : rules_.usual;
            const AlignedPoint& aligned_point = aligned_points_[k - 1];
            if (aligned_point.fixed) continue;
            const int level = level_of(wanted, aligned_point.part);
            const double line = std::ldexp(aligned_point.part, level),
                         to_end = std::min(curve_.arc_length[k], curve_.arc_length.back() - curve_.arc_length[k]);
            const bool stump = to_end < std::max(rules_.shortest_line, nearest_aligned_point * line);
            kept[k] = !stump && aligned_point.number % (std::int64_t{1} << level) == 0 ? 1 : 0;
        }
        drop_close(kept);
        return kept;
    }

    /// Of two aligned points closer to each other than the shortest line, drops the one that is not fixed or has fewer trailing
    /// zero bits in its number.
    void drop_close(std::vector<std::uint8_t>& kept) const {
        std::size_t before = 0;  // last kept point
        for (std::size_t k = 1; k + 1 < kept.size(); ++k) {
            if (kept[k] == 0) continue;
            if (before > 0 && curve_.arc_length[k] - curve_.arc_length[before] < rules_.shortest_line) {
                const AlignedPoint &mine = aligned_points_[k - 1], &other = aligned_points_[before - 1];
                const bool drop_other =
                    mine.fixed || (!other.fixed && (mine.number & -mine.number) > (other.number & -other.number));
                if (!mine.fixed || !other.fixed) kept[drop_other ? before : k] = 0;
                if (!drop_other) continue;
            }
            before = k;
        }
    }

    /// The number of doublings that turn a part [mm] into a line of up to `wanted` [mm], but not shorter than the shortest
    /// line.
    [[nodiscard]] int level_of(double wanted, double part) const {
        const double coarsest = std::floor(std::log2(std::max(wanted / part, 1.0))),
                     finest = std::ceil(std::log2(std::max(rules_.shortest_line / part, 1.0)));
        return static_cast<int>(std::clamp(std::max(coarsest, finest), 0.0, most_doublings));
    }

    [[nodiscard]] NewPlace place(std::size_t k) const {
        const bool is_aligned = k > 0 && k + 1 < curve_.points.size();
        return {curve_.arc_length[k], curve_.points[k], is_aligned && aligned_points_[k - 1].fixed};
    }

    /// Adds the point at k, and before it those between `from` and k that the line needs to stay close enough to the old lines.
    void join(std::size_t from, std::size_t k) {
        if (k == from + 1) {
            pass_old_points(place(from), place(k));
            ends_.push_back(place(k));
            return;
        }
        double farthest = farthest_old_point(place(from), place(k)).distance;
        for (std::size_t i = from + 1; i < k; ++i)
            farthest = std::max(
                farthest,
                (curve_.places[i] - nearest_on_line(curve_.places[i], curve_.points[from], curve_.points[k])).norm());
        if (farthest <= rules_.most && !turns_away(place(from), place(k))) {
            ends_.push_back(place(k));
            return;
        }
        const std::size_t middle = (from + k) / 2;
        join(from, middle);
        join(middle, k);
    }

    struct OldPoint {
        std::size_t index = 0;
        double distance = 0;             ///< [mm] from a line
        Vec3 projection = Vec3::Zero();  ///< on the line
    };

    /// The old point between two places that is farthest from the line between them.
    [[nodiscard]] OldPoint farthest_old_point(const NewPlace& from, const NewPlace& to) const {
        OldPoint found;
        for (auto i = static_cast<std::size_t>(
                 std::upper_bound(old_.arc_length.begin(), old_.arc_length.end(), from.arc_length) -
                 old_.arc_length.begin());
             i < old_.arc_length.size() && old_.arc_length[i] < to.arc_length; ++i) {
            const Vec3 projection = nearest_on_line(old_.points[i], from.position, to.position);
            if (const double off = (old_.points[i] - projection).norm(); off > found.distance)
                found = {i, off, projection};
        }
        return found;
    }

    [[nodiscard]] bool turns_away(const NewPlace& from, const NewPlace& to) const {
        return turning_ != nullptr && turning_->error_of(from, to).greatest > rules_.most_turned;
    }

    /// Adds points near old ones, between two places, if the line between them would be too far from those.
    void pass_old_points(const NewPlace& from, const NewPlace& to) {
        const OldPoint farthest = farthest_old_point(from, to);
        if (farthest.distance <= rules_.most) {
            pass_turns(from, to);
            return;
        }
        const Vec3& left = old_.points[farthest.index];
        const NewPlace middle{old_.arc_length[farthest.index],
                              left + (farthest.projection - left) * (rules_.radius / farthest.distance)};
        pass_old_points(from, middle);
        ends_.push_back(middle);
        pass_old_points(middle, to);
    }

    /// Adds points with the angles of old ones, on the line between two places.
    void pass_turns(const NewPlace& from, const NewPlace& to) {
        if (turning_ == nullptr) return;
        const AxisError error = turning_->error_of(from, to);
        if (error.greatest <= rules_.most_turned || error.point == 0) return;
        const NewPlace middle{old_.arc_length[error.point],
                              nearest_on_line(old_.points[error.point], from.position, to.position)};
        pass_turns(from, middle);
        ends_.push_back(middle);
        pass_turns(middle, to);
    }

    /// The deviation if `dropped` is omitted between two places [mm]; infinite: it is not permitted.
    [[nodiscard]] double error_without(const NewPlace& from, const NewPlace& dropped, const NewPlace& to) const {
        const double own = (dropped.position - nearest_on_line(dropped.position, from.position, to.position)).norm();
        const double farthest = std::max(own, farthest_old_point(from, to).distance);
        return farthest <= rules_.most && !turns_away(from, to) ? farthest : std::numeric_limits<double>::infinity();
    }

    /// Controllers that round corners by arcs slow down at a line much shorter than the adjacent ones, because arcs end in its
    /// middle. One of its ends is dropped if the path permits.
    void drop_short_lines() {
        constexpr double never = std::numeric_limits<double>::infinity();
        const auto length = [](const NewPlace& from, const NewPlace& to) {
            return (to.position - from.position).norm();
        };
        std::vector<NewPlace> kept{{0, old_.points.front()}};
        for (std::size_t k = 0; k < ends_.size(); ++k) {
            const NewPlace& end = ends_[k];
            const NewPlace* next = k + 1 < ends_.size() ? &ends_[k + 1] : nullptr;
            const NewPlace* earlier = kept.size() > 1 ? &kept[kept.size() - 2] : nullptr;
            const double before = earlier != nullptr ? length(*earlier, kept.back()) : never,
                         after = next != nullptr ? length(end, *next) : never;
            if (length(kept.back(), end) < short_share * std::min(before, after)) {
                const double without_begin =
                    earlier != nullptr && !kept.back().fixed ? error_without(*earlier, kept.back(), end) : never;
                const double without_end =
                    next != nullptr && !end.fixed ? error_without(kept.back(), end, *next) : never;
                if (without_end < without_begin) continue;
                if (without_begin < never) kept.pop_back();
            }
            kept.push_back(end);
        }
        ends_.assign(kept.begin() + 1, kept.end());
    }

    const OldSegment& old_;
    const SmoothSegment& curve_;
    const std::vector<AlignedPoint>& aligned_points_;
    const LineRules& rules_;
    const TurningSegment* turning_;
    std::vector<NewPlace> ends_;
};

}  // namespace

std::vector<NewPlace> new_lines(const OldSegment& old, const SmoothSegment& curve,
                                const std::vector<AlignedPoint>& aligned_points, const LineRules& rules,
                                const TurningSegment* turning) {
    return NewLines(old, curve, aligned_points, rules, turning).run();
}

}  // namespace clsurf
