#include "surface/adjacency.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/block.h"
#include "surface/path_grid.h"
#include "toolpath/chords.h"

namespace clsurf {
namespace {

using Vec3f = Eigen::Vector3f;

// All in step-overs.
constexpr float nearest_neighbour = 0.2F;  ///< nearer neighbours are the same pass cut again
constexpr float usual_neighbour = 1.6F;    ///< beyond this a nearer neighbour may have begun and is searched for
// The farthest is stated in docs/predictor.md#limits.
constexpr float farthest_neighbour = 4.0F;  ///< on steep flanks passes are this far apart
constexpr float along_tolerance = 0.35F;    ///< greatest distance of a projection along the feed
constexpr float steep_share = 0.12F;        ///< squared cosine to the horizontal below which a neighbour is above
constexpr float direction_chord = 0.75F;    ///< arc length of the chords that give the feed direction
// As large as farthest_neighbour, so that the 27 cells around a place have every neighbour.
constexpr double grid_cell = 4.0;
constexpr double grid_records =
    1.5;  ///< least cell size in records of usual length, so that a cell has a point of each pass
constexpr float search_again = 0.25F;      ///< arc length without a neighbour after which it is searched again
constexpr float own_arc_length = 1.7F;     ///< least ratio of arc length to distance of a neighbour
constexpr float running_along = 0.8660F;   ///< cos 30°
constexpr PointIndex part_points = 65536;  ///< points of a pass for each thread

/// A point on another pass that is followed while the own point advances.
struct Follower {
    PointIndex point = -1;  ///< −1: lost
    PointRange pass;        ///< it stays inside this pass
    float since = 1e30F;    ///< own arc length since it was lost or searched for [step-overs]
    int direction = 1;      ///< along its pass, of the last step
};

/// The plane normal to the feed at a point. Nothing is normalised: roots would cost more than the walk.
struct Across {
    Vec3f here = Vec3f::Zero();
    Vec3f chord = Vec3f::Zero();  ///< along the feed
    float chord_squared = 0;

    /// The vector from here to a point, without its component along the feed.
    [[nodiscard]] Vec3f aside(const Vec3f& q) const {
        const Vec3f d = q - here;
        return d - d.dot(chord) / chord_squared * chord;
    }

    /// Left or right for a direction: by its horizontal component, and on steep walls (with neighbours above each
    /// other) by the upward component.
    [[nodiscard]] Side side_of(const Vec3f& d) const {
        const float left = chord.x() * d.y() - chord.y() * d.x();  // d · (z × chord)
        const float horizontal = chord.x() * chord.x() + chord.y() * chord.y();
        if (left * left > steep_share * d.squaredNorm() * horizontal) return left > 0 ? Side::left : Side::right;
        // The component along chord × (z × chord), which points upwards.
        const float up = d.z() * chord_squared - d.dot(chord) * chord.z();
        return up > 0 ? Side::left : Side::right;
    }
};

class Walker {
public:
    Walker(const Positions& positions, const Passes& passes, const ArcLength& arc_length, const PathGrid& grid,
           const CutGroups& groups, double step_over, Adjacency& out)
        : p_(positions),
          passes_(passes),
          arc_length_(arc_length),
          grid_(grid),
          groups_(groups),
          step_over_(static_cast<float>(step_over)),
          out_(out) {}

    /// Neighbours of points [first, last] of the pass.
    void walk(std::size_t pass, PointIndex first, PointIndex last) {
        own_pass_ = pass;
        const PointRange own{passes_[pass].first, passes_[pass].last};
        Chords chords(arc_length_, own, first, direction_chord * step_over_);
        std::array<Follower, 2> followers;
        Across across;
        for (PointIndex i = first; i <= last; ++i) {
            if (turn(across, i, p_[chords.ahead()] - p_[chords.behind()])) {
                const float moved = i > first ? arc_length_.step(i - 1) / step_over_ : 0.0F;
                for (Follower& f : followers) f.since += moved;
                follow(across, i, followers);
            }
            for (const Side side : {Side::left, Side::right}) {
                const Follower& f = followers[static_cast<std::size_t>(side)];
                Column<std::int32_t>& column = side == Side::left ? out_.left : out_.right;
                const PointIndex delta = f.point - i;
                const bool fits = f.point >= 0 && std::abs(delta) < std::numeric_limits<std::int32_t>::max();
                column[static_cast<std::size_t>(i)] = fits ? static_cast<std::int32_t>(delta) : Adjacency::none;
            }
            if (i < last) chords.advance();
        }
    }

private:
    /// False if the feed has no direction yet (at rest).
    bool turn(Across& across, PointIndex i, const Vec3f& chord) const {
        across.here = p_[i];
        const float squared = chord.squaredNorm();
        if (squared > 0) {
            across.chord = chord;
            across.chord_squared = squared;
        }
        return across.chord_squared > 0;
    }

    void follow(const Across& across, PointIndex i, std::array<Follower, 2>& followers) const {
        bool search = false;
        for (const Side side : {Side::left, Side::right}) {
            Follower& f = followers[static_cast<std::size_t>(side)];
            if (f.point >= 0) {
                f.point = cross(across, f.point, f.pass, f.direction);
                if (!valid(across, f.point, f.pass, side) || !elsewhere(i, f.point)) {
                    f.point = -1;
                    f.since = search_again;  // search at once
                }
            }
            const float usual = usual_neighbour * step_over_;
            const bool wanted = f.point < 0 || across.aside(p_[f.point]).squaredNorm() > usual * usual;
            search = search || (wanted && f.since >= search_again);
        }
        if (!search) return;
        seek(across, i, followers);
        for (Follower& f : followers) {
            if (f.since >= search_again) f.since = 0;
        }
    }

    /// Walks from `n` to the point of its pass that is nearest to the plane normal to the feed, first in the previous
    /// direction.
    [[nodiscard]] PointIndex cross(const Across& across, PointIndex n, const PointRange& pass, int& direction) const {
        const auto distance = [&](PointIndex k) { return std::abs((p_[k] - across.here).dot(across.chord)); };
        const float begin = distance(n);
        // In the direction in which it comes nearer to the plane; a pass that moves away ends the walk.
        for (int attempt = 0; attempt < 2; ++attempt) {
            PointIndex k = n;
            float best = begin;
            PointIndex standing = 0;
            while (k + direction >= pass.first && k + direction <= pass.last) {
                const float next = distance(k + direction);
                if (next > best) break;
                // If the neighbour was at rest the points do not come nearer: continue within limits.
                standing = next == best ? standing + 1 : 0;
                if (standing > 100'000) break;
                k += direction;
                best = next;
            }
            if (best < begin) return k;
            direction = -direction;
        }
        return n;
    }

    /// Whether `n` is next to the intersection of its pass with the plane, at the side of the point. Records may be
    /// farther apart than passes: the distance of the pass counts, not that of its point.
    [[nodiscard]] bool valid(const Across& across, PointIndex n, const PointRange& pass, Side side) const {
        const Vec3f d = p_[n] - across.here;
        const float along = d.dot(across.chord);
        const float tolerance = along_tolerance * step_over_;
        if (along * along > tolerance * tolerance * across.chord_squared && !crosses(across, n, along, pass))
            return false;
        const Vec3f aside = across.aside(p_[n]);
        const float squared = aside.squaredNorm() / (step_over_ * step_over_);
        if (!(squared > nearest_neighbour * nearest_neighbour && squared < farthest_neighbour * farthest_neighbour)) {
            return false;
        }
        return across.side_of(aside) == side;
    }

    /// Whether one of the steps from and to `n`, which is `along` the feed (times the chord), crosses the plane.
    [[nodiscard]] bool crosses(const Across& across, PointIndex n, float along, const PointRange& pass) const {
        const auto over = [&](PointIndex k) { return (p_[k] - across.here).dot(across.chord) * along <= 0; };
        return (n > pass.first && over(n - 1)) || (n < pass.last && over(n + 1));
    }

    /// Whether the neighbour is another part of the path: the arc length to it is much longer than the distance.
    [[nodiscard]] bool elsewhere(PointIndex i, PointIndex n) const {
        // A long arc length is sufficient; the distance is needed only near a turn.
        const float most = own_arc_length * farthest_neighbour * step_over_;
        return arc_length_.at_least(i, n, most) || arc_length_.at_least(i, n, own_arc_length * (p_[n] - p_[i]).norm());
    }

    /// Whether the neighbour's pass runs along or against the feed.
    [[nodiscard]] bool parallel(const Across& across, PointIndex n, const PointRange& pass) const {
        PointIndex a = n;
        PointIndex b = n;
        const float reach = 0.25F * step_over_;
        while (a > pass.first && (p_[n] - p_[a]).norm() < reach) --a;
        while (b < pass.last && (p_[b] - p_[n]).norm() < reach) ++b;
        const Vec3f chord = p_[b] - p_[a];
        const float dot = chord.dot(across.chord);
        return dot * dot > running_along * running_along * chord.squaredNorm() * across.chord_squared;
    }

    /// Searches the grid for the nearest neighbours on the lost sides.
    void seek(const Across& across, PointIndex i, std::array<Follower, 2>& followers) const {
        // A follower that is not lost is replaced only by a nearer neighbour.
        std::array<float, 2> best{1e30F, 1e30F};
        for (std::size_t s = 0; s < 2; ++s) {
            if (followers[s].point >= 0) best[s] = across.aside(p_[followers[s].point]).norm() - 0.1F * step_over_;
        }
        std::array<Follower, 2> found;
        grid_.for_each_near(across.here, [&](const PathGrid::Entry& entry) {
            if (groups_.apart(own_pass_, static_cast<std::size_t>(entry.pass))) return;
            const PointRange pass{passes_[static_cast<std::size_t>(entry.pass)].first,
                                  passes_[static_cast<std::size_t>(entry.pass)].last};
            int direction = 1;
            const PointIndex n = cross(across, entry.point, pass, direction);
            const Vec3f aside = across.aside(p_[n]);
            const Side side = across.side_of(aside);
            const auto s = static_cast<std::size_t>(side);
            const float distance = aside.norm();
            if (distance >= best[s]) return;
            if (!valid(across, n, pass, side) || !parallel(across, n, pass)) return;
            if (!elsewhere(i, n)) return;
            best[s] = distance;
            found[s] = {n, pass, 0, direction};
        });
        for (std::size_t s = 0; s < 2; ++s) {
            if (found[s].point >= 0) followers[s] = found[s];
        }
    }

    const Positions& p_;
    const Passes& passes_;
    const ArcLength& arc_length_;
    const PathGrid& grid_;
    const CutGroups& groups_;
    std::size_t own_pass_ = 0;
    float step_over_;
    Adjacency& out_;
};

/// Mean arc length of a record on cut passes [mm].
double record_length(const Passes& passes, const ArcLength& arc_length) {
    double length = 0;
    PointIndex records = 0;
    for (const Pass& pass : passes) {
        if (pass.kind != PassKind::cut) continue;
        length += arc_length.to(pass.last) - arc_length.to(pass.first);
        records += pass.size() - 1;
    }
    return records > 0 ? length / static_cast<double>(records) : 0;
}

struct Part {
    std::size_t pass = 0;
    PointIndex first = 0, last = -1;
};

}  // namespace

Adjacency find_neighbours(const Positions& positions, const Passes& passes, const ArcLength& arc_length,
                          double step_over, const CutGroups& groups) {
    Adjacency adjacency;
    const auto count = static_cast<std::size_t>(positions.size());
    adjacency.left.resize(count);
    adjacency.right.resize(count);
    std::vector<Part> parts;
    for (std::size_t pass = 0; pass < passes.size(); ++pass) {
        const Pass& piece = passes[pass];
        for (PointIndex first = piece.first; first <= piece.last; first += part_points) {
            parts.push_back({pass, first, std::min(piece.last, first + part_points - 1)});
        }
    }
    const double cell =
        std::max(grid_cell * (step_over > 0 ? step_over : 1.0), grid_records * record_length(passes, arc_length));
    const PathGrid grid(positions, step_over > 0 ? passes : Passes(), arc_length, cell);
    parallel_for(static_cast<std::int64_t>(parts.size()), 1, [&](std::int64_t from, std::int64_t to) {
        for (std::int64_t k = from; k < to; ++k) {
            const Part& part = parts[static_cast<std::size_t>(k)];
            if (step_over > 0 && passes[part.pass].kind == PassKind::cut) {
                Walker(positions, passes, arc_length, grid, groups, step_over, adjacency)
                    .walk(part.pass, part.first, part.last);
                continue;
            }
            for (PointIndex i = part.first; i <= part.last; ++i) {
                adjacency.left[static_cast<std::size_t>(i)] = Adjacency::none;
                adjacency.right[static_cast<std::size_t>(i)] = Adjacency::none;
            }
        }
    });
    return adjacency;
}

}  // namespace clsurf
