#include "mapping/alignment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "log/placeholder.h"
#include "mapping/motion_grid.h"
#include "mapping/path_walk.h"
#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

// Lengths in mm.
constexpr double sure_distance = 0.02;      ///< a finishing tolerance: full confidence
constexpr double off_distance = 0.1;        ///< from here on the walk may be on a wrong part of the path
constexpr double lost_length = 1.0;         ///< arc length off the path after which the walk counts as lost
constexpr double near_distance = 0.1;       ///< largest distance of a restart
constexpr PointIndex trial_points = 400;    ///< moving points over which a restart must stay near
constexpr double least_jump = 10;           ///< distance of a jump to a placeholder
constexpr double placeholder_reach = 1e-6;  ///< tolerance for the position of a placeholder in workpiece coordinates
constexpr double first_retry = 1.0;         ///< arc length until a failed search is repeated; doubles

class Aligner {
public:
    Aligner(const Trajectory& log, const Program& program, Diagnostics& diagnostics)
        : log_(log), path_(program.motions, first_position(log)), walk_(path_), diagnostics_(diagnostics) {
        motion_.resize(static_cast<std::size_t>(log.count));
        confidence_.resize(static_cast<std::size_t>(log.count));
    }

    void run() {
        WalkState state;
        Vec3 before = first_position(log_);
        double off_path = 0;        // arc length since the walk left the path
        PointIndex off_since = -1;  // first point off the path
        double retry_after = lost_length;
        bool reported = false;
        for (PointIndex i = 0; i < log_.count; ++i) {
            const Vec3 p = position(i);
            if (!p.allFinite()) {
                put(i, LineMap::no_motion, 0.0);
                continue;
            }
            const double chord = (p - before).norm();
            if (chord > least_jump && is_placeholder(p)) {
                put(i, LineMap::no_motion, 0.0);
                continue;
            }
            state = walk_.advance(state, p, chord);
            before = p;
            put(i, static_cast<std::uint32_t>(state.motion), confidence_of(state.distance));
            if (state.distance < off_distance) {
                off_since = -1;
                off_path = 0;
                retry_after = lost_length;
                reported = false;
                continue;
            }
            if (off_since < 0) off_since = i;
            off_path += chord;
            if (state.distance < PathWalk::lost_distance || off_path < retry_after) continue;
            if (const std::optional<Rejoined> found = rejoin(off_since, i, state.motion)) {
                diagnostics_.add({Severity::note,
                                  "map.resumed",
                                  Place::of_point(log_.name, found->point),
                                  fmt::format("the log continues at line {}, not after line {}",
                                              line_of(found->state.motion), line_of(state.motion)),
                                  {}});
                state = found->state;
                i = found->point;
                before = position(i);
                put(i, static_cast<std::uint32_t>(state.motion), confidence_of(state.distance));
                off_since = -1;
                off_path = 0;
                retry_after = lost_length;
                continue;
            }
            retry_after = 2 * off_path + first_retry;
            if (!reported) {
                diagnostics_.add({Severity::warning, "map.lost", Place::of_point(log_.name, off_since),
                                  fmt::format("the log leaves the programmed path after line {} and "
                                              "is {:.3f} mm off",
                                              line_of(state.motion), state.distance),
                                  "another program, another version of it, or another work offset?"});
            }
            reported = true;
        }
    }

    LineMap take(const Program& program) { return {std::move(motion_), std::move(confidence_), program}; }

private:
    static Vec3 first_position(const Trajectory& log) {
        for (PointIndex i = 0; i < log.count; ++i) {
            const Vec3 p = log.at(i);
            if (p.allFinite()) return p;
        }
        return Vec3::Zero();
    }

    /// Reads through a window, because channels are gathered by block.
    Vec3 position(PointIndex i) {
        // Points that are read at once; results do not depend on it.
        constexpr PointIndex window = 4096;
        if (i < window_begin_ || i >= window_begin_ + static_cast<PointIndex>(x_.size())) {
            const auto n = static_cast<std::size_t>(std::min(window, log_.count - i));
            x_.resize(n);
            y_.resize(n);
            z_.resize(n);
            log_.read(i, x_, y_, z_);
            window_begin_ = i;
        }
        const auto k = static_cast<std::size_t>(i - window_begin_);
        return {x_[k], y_[k], z_[k]};
    }

    static double confidence_of(double distance) { return distance <= sure_distance ? 1.0 : sure_distance / distance; }
    [[nodiscard]] LineNumber line_of(std::int64_t motion) const {
        return path_.motions().line[static_cast<std::size_t>(motion)];
    }
    void put(PointIndex i, std::uint32_t motion, double confidence) {
        motion_[static_cast<std::size_t>(i)] = motion;
        confidence_[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(confidence * 255));
    }

    /// A restart of the walk.
    struct Rejoined {
        PointIndex point = 0;
        WalkState state;
    };

    /// Searches from point `off` on, at which the walk left the path, or, after a section that is not in the program
    /// (a retract, the return to the point of continuation), from the first point that is back on it; `now` is the
    /// last point that was read. O(log(now − off)) searches.
    std::optional<Rejoined> rejoin(PointIndex off, PointIndex now, std::int64_t from) {
        // The first motion begins at the first point of the log, so its first points are no evidence.
        if (from == 0) off = 0;
        if (const std::optional<WalkState> state = search(off, from)) return Rejoined{off, *state};
        const std::optional<WalkState> state = search(now, from);
        if (!state) return std::nullopt;
        Rejoined back{now, *state};
        for (PointIndex still_off = off; back.point - still_off > 1;) {
            const PointIndex middle = still_off + (back.point - still_off) / 2;
            if (const std::optional<WalkState> earlier = search(middle, from))
                back = {middle, *earlier};
            else
                still_off = middle;
        }
        return back;
    }

    /// The first place at or after motion `from` (then: in the whole program) from which the walk stays near for the
    /// following points.
    std::optional<WalkState> search(PointIndex point, std::int64_t from) {
        if (!grid_) grid_.emplace(path_);
        const Vec3 p = log_.at(point);
        std::vector<std::int64_t> near = grid_->near(p, near_distance);
        const auto after = std::lower_bound(near.begin(), near.end(), from);
        std::rotate(near.begin(), after, near.end());
        for (const std::int64_t motion : near) {
            const Projection projection = path_.projection(motion, p);
            const WalkState start{motion, projection.fraction, projection.distance};
            if (stays_near(start, point)) return start;
        }
        return std::nullopt;
    }

    bool stays_near(WalkState state, PointIndex point) {
        Vec3 before = log_.at(point);
        PointIndex moving = 0;
        for (PointIndex i = point + 1; i < log_.count && moving < trial_points; ++i) {
            const Vec3 p = log_.at(i);
            const double chord = (p - before).norm();
            if (!(chord > 0) || (chord > least_jump && is_placeholder(p))) continue;
            ++moving;
            state = walk_.advance(state, p, chord);
            before = p;
            if (state.distance > near_distance) return false;
        }
        return moving > 0;
    }

    /// Whether this position is a placeholder of the log.
    bool is_placeholder(const Vec3& p) {
        if (!placeholder_) {
            const std::optional<Placeholder> found = find_placeholder(log_.axes);
            placeholder_ = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
            if (found) placeholder_ = log_.pose().inverse() * Vec3(found->position.data());
        }
        return (p - *placeholder_).squaredNorm() < placeholder_reach * placeholder_reach;
    }

    const Trajectory& log_;
    Toolpath path_;
    PathWalk walk_;
    Diagnostics& diagnostics_;
    std::optional<MotionGrid> grid_;
    std::optional<Vec3> placeholder_;  ///< NaN: the log has none; empty: not yet determined
    Column<std::uint32_t> motion_;
    Column<std::uint8_t> confidence_;
    std::vector<double> x_, y_, z_;
    PointIndex window_begin_ = 0;
};

}  // namespace

LineMap align_lines(const Trajectory& path, const Program& program, Diagnostics& diagnostics) {
    if (program.motions.size() == 0) {
        const auto n = static_cast<std::size_t>(path.count);
        return {Column<std::uint32_t>(n, LineMap::no_motion), Column<std::uint8_t>(n, 0), program};
    }
    Aligner aligner(path, program, diagnostics);
    aligner.run();
    return aligner.take(program);
}

}  // namespace clsurf
