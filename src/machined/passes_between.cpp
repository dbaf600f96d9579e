#include "machined/passes_between.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/point_ranges.h"

namespace clsurf {
namespace {

constexpr double most_uneven = 3;       ///< times the distance of the two passes; farther passes are not used
constexpr double most_jump = 4;         ///< times the step along the pass; a longer step leads to another pass
constexpr float least_between = 0.25F;  ///< share of a gap: a pass this far from both sides is between them
constexpr double jump_fits = 0.15;      ///< share of a gap by which a jump's positions from both sides may differ
constexpr double least_jump = 2e-4;     ///< [mm] second difference: below it a cubic is as good
constexpr double least_turn = 3e-3;     ///< [mm] change of second differences; less may be rounding or uneven heights
constexpr double smoother_side = 0.25;  ///< share of the change of second differences on a side without a turn
constexpr double corner_turns = 8;      ///< times the adjacent bends: the sides of a valley are nearly straight

/// Passes around the gap between two passes, numbered from the first of these.
class Across {
public:
    void set(int number, const Vec3& at) {
        at_[index(number)] = at;
        known_[index(number)] = true;
    }
    [[nodiscard]] bool has(int number) const { return known_[index(number)]; }
    [[nodiscard]] const Vec3& at(int number) const { return at_[index(number)]; }
    /// The second derivative at a pass, in units of the gap. Passes need not be evenly spaced.
    [[nodiscard]] Vec3 bend(int number) const {
        const Vec3 to = at(number) - at(number - 1), on = at(number + 1) - at(number);
        const double before = to.norm(), after = on.norm();
        return gap_squared() * 2 / (before + after) * (on / after - to / before);
    }
    /// The same, rotated with the path from the pass to the gap, so that it is normal to the chord of the gap, as the second
    /// derivative of the path is there. If the path turns by 0.2 rad from pass to pass, the bends of two passes on one circle
    /// differ by that angle, and a circle next to a line would seem to bend less than it does.
    [[nodiscard]] Vec3 bend_in_gap(int number) const {
        const Vec3 through = (at(number) - at(number - 1)).normalized() + (at(number + 1) - at(number)).normalized();
        const Vec3 from = through.normalized(), to = (at(1) - at(0)).normalized();
        const double cosine = from.dot(to);
        const Vec3 here = bend(number);
        if (!(cosine > 0)) return here;  // the path reverses
        const Vec3 axis = from.cross(to);
        return here + axis.cross(here) + axis.cross(axis.cross(here)) / (1 + cosine);
    }
    /// Effect of a change of the bend in the gap on the bend of a pass at its ends, relative to evenly spaced passes.
    [[nodiscard]] double weight_of_gap(int number) const {
        const double gap = std::sqrt(gap_squared());
        return 2 * gap / ((at(number) - at(number - 1)).norm() + (at(number + 1) - at(number)).norm());
    }

private:
    [[nodiscard]] double gap_squared() const { return (at(1) - at(0)).squaredNorm(); }
    static std::size_t index(int number) {
        const int from_first = number + 2;
        return static_cast<std::size_t>(from_first);
    }
    std::array<Vec3, 6> at_;  // -2 … 3
    std::array<bool, 6> known_{};
};

/// The place `found` on the pass adjacent to `from`, or the one on a pass between both. Near a turn, the pass that it leads to
/// is too near along the path to be a neighbour, so the search finds the pass beyond it.
PathLocation on_adjacent_pass(const ClSurface& surface, const PathLocation& from, const PathLocation& found,
                              const Eigen::Vector3f& feed) {
    if (!found.exists()) return found;
    const Positions& p = surface.positions;
    const PointIndex own = found.nearest();
    const Eigen::Vector3f here = position_at(p, from), there = position_at(p, found), across = there - here;
    for (const Side side : {Side::left, Side::right}) {
        if (!surface.neighbours.has(side, own)) continue;
        if ((p[surface.neighbours.neighbour(side, own)] - there).dot(across) >= 0) continue;
        const PathLocation back = adjacent_location(surface, found, feed, side);
        const float share = back.exists() ? (position_at(p, back) - here).dot(across) / across.squaredNorm() : 0;
        return share > least_between && share < 1 - least_between ? back : found;
    }
    return found;
}

/// A curve between two passes, 0 … 1.
class AcrossCurve {
public:
    explicit AcrossCurve(const Across& p) : from_(p.at(0)), chord_(p.at(1) - p.at(0)) {
        const bool before = p.has(-1), after = p.has(2);
        if (before) bend_ = turn_ = p.bend_in_gap(0);
        if (after) turn_ = p.bend_in_gap(1);
        if (after && !before) bend_ = turn_;
        if (!before || !after) return;
        if (p.has(-2) && p.has(3)) {
            if (meets_parabolas(p, p.bend_in_gap(-1), p.bend_in_gap(2))) return;
            // Bends at a corner are not rotated: its sides continue in their own directions.
            if (turns_corner(p, p.bend(-1), p.bend(2))) return;
        }
        use_smoother_side(p);
    }

    [[nodiscard]] Vec3 at(double x) const { return from_ + x * (chord_ - over(1)) + over(x); }

private:
    /// If passes are evenly spaced, two parabolas with bends `low` and `high` that meet at a fraction x of the gap give its
    /// ends the bends low + (high − low) (1 − x)²/2 and high − (high − low) x²/2.
    bool meets_parabolas(const Across& p, const Vec3& low, const Vec3& high) {
        const Vec3 jump = high - low;
        const double squared = jump.squaredNorm();
        if (squared < least_jump * least_jump) return false;
        const double first = std::sqrt(2 / p.weight_of_gap(0) * std::max(0.0, (bend_ - low).dot(jump) / squared));
        const double second = std::sqrt(2 / p.weight_of_gap(1) * std::max(0.0, (high - turn_).dot(jump) / squared));
        if (std::abs(first + second - 1) > jump_fits) return false;
        meets_ = second / (first + second);
        bend_ = low;
        turn_ = high;
        return true;
    }

    /// A corner in the gap, where the extrapolations of both sides meet. Only in a valley, because the tool rolls around a
    /// nearly sharp edge.
    bool turns_corner(const Across& p, const Vec3& low, const Vec3& high) {
        const Vec3 to = p.at(0) - p.at(-1), on = p.at(2) - p.at(1);
        const double squared = chord_.squaredNorm();
        const Vec3 down = (to / to.norm() + 0.5 * to.norm() / squared * low).normalized();
        const Vec3 up = (on / on.norm() - 0.5 * on.norm() / squared * high).normalized();
        const double cosine = down.dot(up), sine_squared = 1 - cosine * cosine;
        const double first = (chord_.dot(down) - cosine * chord_.dot(up)) / sine_squared;
        const double second = (chord_.dot(up) - cosine * chord_.dot(down)) / sine_squared;
        if (!(first > 0 && second > 0)) return false;
        const double share = first / (first + second);
        const Vec3 corner = (share * chord_ - first * down) / (share * (1 - share));
        if (corner.z() < least_turn + corner_turns * (low.norm() + high.norm())) return false;
        meets_ = share;
        corner_ = corner;
        bend_ = low;
        turn_ = high;
        return true;
    }

    /// If the path across the passes turns or changes its curvature at a pass or in the adjacent gap, only the passes on the
    /// other side are used: a cubic through both sides would overshoot.
    void use_smoother_side(const Across& p) {
        const Vec3 change = turn_ - bend_;
        const Vec3 before = p.has(-2) ? Vec3(bend_ - p.bend_in_gap(-1)) : change;
        const Vec3 after = p.has(3) ? Vec3(p.bend_in_gap(2) - turn_) : change;
        const double most = smoother_side * change.norm();
        if (change.norm() < least_turn || std::min(before.norm(), after.norm()) > most) return;
        if (after.norm() < before.norm())
            bend_ = turn_ - after;
        else
            turn_ = bend_ + before;
    }

    /// The contribution of the second differences.
    [[nodiscard]] Vec3 over(double x) const {
        if (meets_ < 0) return 0.5 * x * x * bend_ + x * x * x / 6 * (turn_ - bend_);
        const double beyond = std::max(0.0, x - meets_);
        return 0.5 * x * x * bend_ + beyond * corner_ + 0.5 * beyond * beyond * (turn_ - bend_);
    }

    Vec3 from_, chord_;
    Vec3 bend_ = Vec3::Zero(), turn_ = Vec3::Zero();
    Vec3 corner_ = Vec3::Zero();  ///< change of direction …
    double meets_ = -1;           ///< … or of the bend, at this fraction of the gap; < 0: none
};

}  // namespace

PassesBetween::PassesBetween(const ClSurface& surface, const Signals& signals, const Differentiator* smoother,
                             const std::vector<PointRange>& pieces, std::span<const PointRange> near,
                             const CuttingTool& tool, double cell, const ProgrammedMarks& marks)
    : surface_(surface),
      signals_(signals),
      smoother_(smoother),
      pieces_(pieces),
      marks_(marks),
      longest_(longest_piece(tool, cell)),
      least_(2 * cell) {
    if (smoother == nullptr) return;
    for (const PointRange& points : near) {
        runs_.push_back({points.first, {}});
        smooth_into(points, runs_.back().at);
    }
}

void PassesBetween::smooth_into(PointRange points, std::vector<Eigen::Vector3f>& smoothed) const {
    const Positions& p = surface_.positions;
    smoothed.reserve(static_cast<std::size_t>(points.size()));
    auto piece = range_at(pieces_, points.first);
    std::vector<double> samples, values[3];
    for (PointIndex first = points.first; first <= points.last;) {
        while (piece != pieces_.end() && piece->last < first) ++piece;
        if (piece == pieces_.end() || piece->first > first) {  // outside of all pieces: not smoothed
            smoothed.emplace_back(p[first] - marks_.at(first).cast<float>());
            ++first;
            continue;
        }
        const PointIndex last = std::min(points.last, piece->last);
        const PointIndex from = std::max(piece->first, first - smoother_->reach());
        const PointIndex to = std::min(piece->last, last + smoother_->reach());
        p.fill.need(from, to);
        for (int axis = 0; axis < 3; ++axis) {
            const Column<float>& column = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
            samples.assign(column.data() + from, column.data() + to + 1);
            marks_.take_off(from, axis, samples);
            values[axis].resize(static_cast<std::size_t>(last - first + 1));
            smoother_->apply(samples, from, *piece, first, values[axis]);
        }
        for (std::size_t k = 0; k < values[0].size(); ++k)
            smoothed.emplace_back(static_cast<float>(values[0][k]), static_cast<float>(values[1][k]),
                                  static_cast<float>(values[2][k]));
        first = last + 1;
    }
}

Vec3 PassesBetween::smooth(PointIndex point) const {
    const Positions& p = surface_.positions;
    if (smoother_ == nullptr) return p.absolute(point) - marks_.at(point);
    const auto run = range_at(runs_, point);
    if (run != runs_.end() && run->first <= point) {
        const PointIndex off = point - run->first;
        if (off < static_cast<PointIndex>(run->at.size()))
            return run->at[static_cast<std::size_t>(off)].cast<double>() + p.origin;
    }
    std::vector<Eigen::Vector3f> one;
    smooth_into({point, point}, one);
    return one.front().cast<double>() + p.origin;
}

Vec3 PassesBetween::smooth(const PathLocation& at) const {
    return interpolate([&](PointIndex i) { return smooth(i); }, at);
}

bool PassesBetween::between(PointIndex point, Side side, Row& row) const {
    if (!surface_.neighbours.has(side, point) || surface_.neighbours.neighbour(side, point) < point) return false;
    const Eigen::Vector3f feed = signals_.feed(point);
    if (!feed.allFinite()) return false;
    const PathLocation own{point, 0};
    const auto adjacent = [&](const PathLocation& from, const PathLocation& found) {
        return on_adjacent_pass(surface_, from, found, feed);
    };
    const PathLocation next = adjacent(own, adjacent_location(surface_, own, feed, side));
    if (!next.exists()) return false;
    Across across;
    across.set(0, smooth(point));
    across.set(1, smooth(next));
    const double apart = (across.at(1) - across.at(0)).norm();
    if (!(apart > 0)) return false;
    // Continues from pass to pass, as long as their distances are similar.
    const auto go_on = [&](PathLocation before, PathLocation from, int number, int direction) {
        for (int k = 0; k < 2 && from.exists(); ++k) {
            const Vec3 at = smooth(from);
            const double step = (at - across.at(number - direction)).norm();
            if (!(step > apart / most_uneven && step < most_uneven * apart)) return;
            across.set(number, at);
            const PathLocation on = adjacent(from, beyond(surface_, before, from, feed));
            before = from;
            from = on;
            number += direction;
        }
    };
    const Side other = side == Side::left ? Side::right : Side::left;
    go_on(own, adjacent(own, adjacent_location(surface_, own, feed, other)), -1, -1);
    go_on(next, adjacent(next, beyond(surface_, own, next, feed)), 2, 1);
    const AcrossCurve curve(across);
    for (int k = 0; k < count; ++k)
        row[static_cast<std::size_t>(k)] = curve.at(static_cast<double>(k + 1) / (count + 1));
    return std::all_of(row.begin(), row.end(), [](const Vec3& p) { return p.allFinite(); });
}

/// Calls take(from, to) for the straight motions along the passes between the passes of points and the adjacent ones.
template <typename Take>
void PassesBetween::motions_of_adjacent(PointRange points, Side side, Take&& take) const {
    std::optional<Row> before;
    PointIndex last = points.first;
    for (PointIndex i = points.first; i <= points.last; ++i) {
        Row row;
        // If points are merged, so are their neighbours, which are also on a line.
        if (before && i < points.last &&
            (surface_.positions[i] - surface_.positions[last]).norm() < static_cast<float>(least_))
            continue;
        if (!between(i, side, row)) {
            before.reset();
            continue;
        }
        if (before) {
            const double step = (surface_.positions[i] - surface_.positions[last]).norm();
            for (std::size_t k = 0; k < row.size(); ++k) {
                if ((row[k] - (*before)[k]).norm() <= most_jump * step + least_) take((*before)[k], row[k]);
            }
        }
        before = row;
        last = i;
    }
}

template <typename Take>
void PassesBetween::motions(PointRange points, std::size_t piece, bool goes_on, Take&& take) const {
    const PointRange& range = pieces_[piece];
    const PointRange to_next{points.first, points.last + (goes_on ? 1 : 0)};
    std::optional<Vec3> before;
    for (PointIndex i = to_next.first; i <= to_next.last; ++i) {
        const Vec3 at = smooth(i);
        if (before && (at - *before).head<2>().norm() < 0.5 * least_ && i < to_next.last) continue;
        if (before) take(*before, at);
        before = at;
    }
    const PointRange inside{to_next.first, std::min(to_next.last, range.last)};
    for (const Side side : {Side::left, Side::right}) motions_of_adjacent(inside, side, take);
}

void PassesBetween::keep(PointRange points, std::size_t piece, bool goes_on) {
    Kept kept{points.first, {}};
    motions(points, piece, goes_on, [&](const Vec3& from, const Vec3& to) { kept.motions.push_back({from, to}); });
    kept_.push_back(std::move(kept));
}

void PassesBetween::add(PointRange points, std::size_t piece, bool goes_on, const FrameAxes& axes,
                        SweptPieces& swept) const {
    const auto sweep = [&](const Vec3& from, const Vec3& to) { swept.add(axes(from), axes(to), longest_); };
    const auto kept = std::lower_bound(kept_.begin(), kept_.end(), points.first,
                                       [](const Kept& k, PointIndex first) { return k.first < first; });
    if (kept == kept_.end() || kept->first != points.first) return motions(points, piece, goes_on, sweep);
    for (const Motion& motion : kept->motions) sweep(motion.from, motion.to);
}

}  // namespace clsurf
