#include "repair/points/deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"
#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

// The same as in docs/experiments/repair.md#the-search-in-detail, Deviation.
constexpr double window = 1.0;       ///< [mm] of arc length to both sides of the present position
constexpr double same_place = 1e-9;  ///< [mm]; ten times the rounding of doubles at 1 km
constexpr double most_pieces = 1e6;  ///< of one motion; a guard: 50 m in steps of 0.05 mm
constexpr double turn_step = rad_per_deg;
// A quarter turn: docs/optimize.md#five-axes.
constexpr double most_wound = 90 * rad_per_deg;  ///< most that a rotary axis turns for the same tool direction

/// The distance of a place from another path.
struct Apart {
    double distance = std::numeric_limits<double>::infinity();  ///< [mm]
    double turned = 0;                                          ///< [rad] the tool axis there
    double wound = 0;  ///< [rad] difference of the rotary axis that differs most there
};

/// A place to be compared with another path.
struct Sample {
    Vec3 position = Vec3::Zero();  ///< [mm]
    RotaryAngles angles;
    Vec3 axis = Vec3::UnitZ();
};

/// Follows a path along points that are in its order.
class Walk {
public:
    /// `orientation`: of the path; nullptr: three axes.
    Walk(const Toolpath& path, const Orientation* orientation) : path_(path), orientation_(orientation) {}

    /// The distance of `sample` from the path near the projection of the previous one.
    [[nodiscard]] Apart apart(const Sample& sample) {
        std::int64_t low = at_;
        double before = arc_length_before_;
        while (low > 0 && before > arc_length_ - window) before -= path_.length(--low);
        Apart apart;
        double arc_length = arc_length_;
        for (std::int64_t m = low;
             m < path_.size() && (before <= arc_length + window || !std::isfinite(apart.distance)); ++m) {
            const double length = path_.length(m);
            if (length <= 0 && std::isfinite(apart.distance)) continue;
            Projection projection = path_.projection(m, sample.position);
            if (length > 0) {
                // Only the section of a long motion inside the window counts.
                const double inside =
                    std::clamp(projection.fraction, std::clamp((arc_length - window - before) / length, 0.0, 1.0),
                               std::clamp((arc_length + window - before) / length, 0.0, 1.0));
                if (inside != projection.fraction)
                    projection = {(path_.at(m, inside) - sample.position).norm(), inside};
            }
            // Of two equally near projections the later one counts, so that the walk does not move back on a path that
            // reverses.
            if (projection.distance <= apart.distance + same_place) {
                if (orientation_ != nullptr) compare_axes(sample, m, projection, apart);
                apart.distance = std::min(apart.distance, projection.distance);
                at_ = m;
                arc_length_before_ = before;
                arc_length_ = before + (length > 0 ? projection.fraction * length : 0);
            }
            before += length;
        }
        return apart;
    }

    /// Moves along the next line of the path if it is the same as line `i` of another path: the distance of its points is then
    /// known.
    [[nodiscard]] bool advance_if_equal(const Toolpath& other, std::int64_t i) {
        if (orientation_ != nullptr || !is_line(other, i)) return false;
        double before = arc_length_before_;
        for (std::int64_t m = at_; m < std::min(at_ + 2, path_.size()); before += path_.length(m++)) {
            if (!is_line(path_, m) || path_.begin(m) != other.begin(i) || path_.end(m) != other.end(i)) continue;
            at_ = m;
            arc_length_before_ = before;
            arc_length_ = before + path_.length(m);
            return true;
        }
        return false;
    }

private:
    [[nodiscard]] static bool is_line(const Toolpath& path, std::int64_t i) {
        return path.motions().kind[static_cast<std::size_t>(i)] == MotionKind::feed;
    }
    /// Of equally near projections, the one with the most similar tool axis counts.
    void compare_axes(const Sample& sample, std::int64_t motion, const Projection& projection, Apart& apart) const {
        const RotaryAngles angles = orientation_->angles(motion, projection.fraction);
        const double turned = angle_between(sample.axis, orientation_->axis(angles));
        const bool equally_near = projection.distance >= apart.distance - same_place;
        if (equally_near && turned > apart.turned) return;
        apart.turned = turned;
        apart.wound = turn_between(sample.angles, angles);
    }

    const Toolpath& path_;
    const Orientation* orientation_;
    std::int64_t at_ = 0;
    double arc_length_before_ = 0, arc_length_ = 0;
};

/// A path, and the tool axis along it.
struct Course {
    const Toolpath& path;
    const Orientation* orientation = nullptr;

    [[nodiscard]] double turn_of(std::int64_t motion) const {
        return orientation == nullptr ? 0
                                      : turn_between(orientation->angles(motion, 0), orientation->angles(motion, 1));
    }
};

/// Calls take(motion, point, distance) for points of `from` compared with `to`.
template <typename Take>
void compare(const Course& from, const Course& to, double step, const Take& take) {
    Walk walk(to.path, to.orientation);
    const Toolpath& path = from.path;
    for (std::int64_t i = 0; i < path.size(); ++i) {
        if (walk.advance_if_equal(path, i)) continue;
        // Sections between rapids must exist; rapids themselves are compared by their ends.
        const bool rapid = path.motions().kind[static_cast<std::size_t>(i)] == MotionKind::rapid;
        const double pieces = rapid ? std::ceil(path.length(i) / (0.5 * window))
                                    : std::ceil(std::max(path.length(i) / step, from.turn_of(i) / turn_step));
        const auto n = static_cast<int>(std::clamp(pieces, 1.0, most_pieces));
        for (int k = 1; k <= n; ++k) {
            const double part = static_cast<double>(k) / n;
            Sample sample{path.at(i, part), {}, Vec3::UnitZ()};
            if (from.orientation != nullptr) {
                sample.angles = from.orientation->angles(i, part);
                sample.axis = from.orientation->axis(sample.angles);
            }
            Apart apart = walk.apart(sample);
            // Rapids and rotations in place are compared word by word.
            if (rapid || path.length(i) <= 0) apart.turned = apart.wound = 0;
            take(i, sample.position, apart);
        }
    }
}

/// Whether a repair may replace a motion by others: it is compared by distances along it, not by its words.
bool is_plain(const Course& course, std::int64_t i) {
    const Motions& motions = course.path.motions();
    const auto k = static_cast<std::size_t>(i);
    const bool turns = !motions.rotary.empty() && i > 0 && !(motions.rotary[k] == motions.rotary[k - 1]);
    const bool turns_on_the_way = course.orientation != nullptr && course.path.length(i) > 0;
    const bool repaired = motions.kind[k] == MotionKind::feed || motions.kind[k] == MotionKind::spline;
    return repaired && (!turns || turns_on_the_way);
}

bool same(const Motions& a, std::int64_t i, const Motions& b, std::int64_t j) {
    const auto k = static_cast<std::size_t>(i), l = static_cast<std::size_t>(j);
    const auto equal = [](const Xyz& p, const Xyz& q) {
        const auto one = [](double x, double y) { return std::abs(x - y) <= same_place || (x != x && y != y); };
        return one(p.x, q.x) && one(p.y, q.y) && one(p.z, q.z);
    };
    if (a.kind[k] != b.kind[l] || !equal(a.end[k], b.end[l])) return false;
    const bool feeds = a.feed[k] == b.feed[l] || (a.feed[k] != a.feed[k] && b.feed[l] != b.feed[l]);
    if (!feeds) return false;
    if (!a.rotary.empty() && !equal(a.rotary[k], b.rotary[l])) return false;
    const Curve *curve = a.curve_of(i), *other_curve = b.curve_of(j);
    if ((curve == nullptr) != (other_curve == nullptr)) return false;
    if (curve != nullptr && !curve->span->same_as(*other_curve->span, same_place)) return false;
    const Arc *arc = a.arc_of(i), *other = b.arc_of(j);
    if (arc == nullptr || other == nullptr) return arc == other;
    return arc->centre == other->centre && arc->turns == other->turns && arc->axis == other->axis;
}

LineNumber first_disorder(const Course& before, const Course& after) {
    const Motions &a = before.path.motions(), &b = after.path.motions();
    if (a.rotary.empty() != b.rotary.empty()) return 1;
    std::int64_t i = 0, j = 0;
    while (true) {
        while (i < a.size() && is_plain(before, i)) ++i;
        while (j < b.size() && is_plain(after, j)) ++j;
        if (i == a.size() && j == b.size()) return 0;
        if (i == a.size() || j == b.size() || !same(a, i, b, j))
            return b.size() > 0 ? b.line[static_cast<std::size_t>(std::min(j, b.size() - 1))] : 1;
        ++i, ++j;
    }
}

}  // namespace

Deviation measure_deviation(const Program& before, const Program& after, double step,
                            const Orientations& orientations) {
    const Toolpath old_path(before.motions, Vec3::Zero()), new_path(after.motions, Vec3::Zero());
    const Course old{old_path, orientations.before}, now{new_path, orientations.after};
    Deviation deviation;
    deviation.disordered = first_disorder(old, now);
    const auto take = [&](const LineOfEither& line, const Vec3& p, const Apart& apart) {
        if (apart.distance > deviation.greatest) {
            deviation.greatest = apart.distance;
            deviation.line = line;
            deviation.position = p;
        }
        if (apart.turned > deviation.turned) {
            deviation.turned = apart.turned;
            deviation.turned_line = line;
        }
        if (apart.wound > most_wound && deviation.disordered == 0)
            deviation.disordered = line.of_first ? 1 : std::max<LineNumber>(1, line.line);
    };
    compare(now, old, step, [&](std::int64_t i, const Vec3& p, const Apart& apart) {
        take({after.motions.line[static_cast<std::size_t>(i)], false}, p, apart);
    });
    compare(old, now, step, [&](std::int64_t i, const Vec3& p, const Apart& apart) {
        take({before.motions.line[static_cast<std::size_t>(i)], true}, p, apart);
    });
    return deviation;
}

}  // namespace clsurf
