#include "mapping/work_offset.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "core/decimal_text.h"
#include "core/listed.h"
#include "core/statistics.h"
#include "core/units.h"
#include "mapping/allowed_motions.h"
#include "mapping/motion_grid.h"
#include "mapping/path_profile.h"
#include "program/frame_placement.h"
#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

// A bound on the time: about 10^5 points.
constexpr PointIndex sections = 64;   ///< evenly spaced over the log
constexpr PointIndex section = 1600;  ///< points
constexpr std::size_t samples_of_section = 24;
constexpr std::size_t least_samples = 100;
constexpr std::size_t least_changes = 10;  ///< number of line changes needed for an initial guess
// near: docs/howto/work_frames.md.
constexpr double near = 0.05;    ///< [mm] on the path: a corner tolerance of finishing
constexpr double most_near = 2;  ///< [mm] with the program's own corner tolerance
constexpr double near_share = 0.9;
constexpr double found_share = 0.5;   ///< a guess with this share of the points within reach is refined
constexpr double reach = 0.5;         ///< [mm] least size of the grid's cells
constexpr double same_shift = 0.02;   ///< [mm]
constexpr double least_turn = 0.01;   ///< [mm] at the part's rim; a smaller rotation counts as none
constexpr double more_points = 0.01;  ///< share of the points that distinguishes poses one pass apart
constexpr double far_better = 1.5;    ///< ratio of the residuals of distinct poses
constexpr std::size_t profile_points = 32768;
constexpr std::size_t hypotheses = 400;  ///< pairs of line changes that are tested
constexpr double pair_tolerance = 1;     ///< [mm] from a line change to the end of its line, plus the corner tolerance
constexpr int most_rounds = 30;
constexpr double settled = 1e-5;        ///< [mm]
constexpr double least_scatter = 1e-3;  ///< [mm] smaller residuals count as this
constexpr double determined = 1e-3;     ///< share of the points' directions in the weakest direction

/// A moving point and its possible motions.
struct PathSample {
    Vec3 position;
    MotionRange motions;  ///< empty: all
};

struct PathSamples {
    std::vector<PathSample> points;
    std::vector<PointPair> at_changes;  ///< at a line change: the position, and the end of the line
};

PathSamples take_samples(const Trajectory& path, const Toolpath& toolpath, const LineMap* map, int system = 0) {
    const auto counts = [&](std::int64_t motion) {
        return system == 0 || toolpath.motions().frame_of(motion).system == system;
    };
    PathSamples samples;
    const PointIndex n = std::min(path.count, section);
    const PointIndex count = std::min(sections, path.count / n);
    std::vector<double> x(static_cast<std::size_t>(n)), y(x.size()), z(x.size());
    std::vector<LineNumber> lines(x.size(), 0);
    const std::size_t every = std::max<std::size_t>(
        1, x.size() * static_cast<std::size_t>(count) / (static_cast<std::size_t>(sections) * samples_of_section));
    for (PointIndex s = 0; s < count; ++s) {
        const PointIndex begin = count == 1 ? 0 : (path.count - n) / (count - 1) * s;
        path.read(begin, x, y, z);
        if (map != nullptr) map->read(begin, lines);
        std::int64_t earlier = -1, before = -1;
        bool known = map == nullptr || begin == 0;
        std::size_t moving = 0;
        for (std::size_t i = 1; i < x.size(); ++i) {
            const Vec3 p(x[i], y[i], z[i]);
            const Vec3 last(x[i - 1], y[i - 1], z[i - 1]);
            if (map != nullptr && lines[i] != lines[i - 1]) {
                earlier = before;
                before = map->motion_at(begin + static_cast<PointIndex>(i) - 1);
                known = true;
                const std::span<const std::uint32_t> ended = map->motions_of(lines[i - 1]);
                if (ended.size() == 1 && last.allFinite() && counts(ended.front())) {
                    const Vec3 end = toolpath.end(ended.front());
                    if (end.allFinite()) samples.at_changes.push_back({last, end});
                }
            }
            if (!p.allFinite() || !((p - last).squaredNorm() > 0) || !known || (map != nullptr && lines[i] == 0))
                continue;
            if (moving++ % every != 0) continue;
            PathSample sample{p, {0, -1}};
            if (map != nullptr) {
                const std::int64_t motion = map->motion_at(begin + static_cast<PointIndex>(i));
                if (motion < 0 || !counts(motion)) continue;
                const MotionRange range = allowed_motions(begin_of_merge(earlier, before), motion, toolpath.size());
                sample.motions = {range.first, range.last};
            }
            samples.points.push_back(std::move(sample));
        }
    }
    return samples;
}

Box3 box_of(const Toolpath& path) {
    constexpr int pieces = 16;
    Box3 box;
    const auto extend = [&](const Vec3& p) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!std::isfinite(p[axis])) continue;
            box.min()[axis] = std::min(box.min()[axis], p[axis]);
            box.max()[axis] = std::max(box.max()[axis], p[axis]);
        }
    };
    for (std::int64_t m = 0; m < path.size(); ++m) {
        extend(path.end(m));
        if (!is_curved(path.motions().kind[static_cast<std::size_t>(m)])) continue;
        for (int k = 0; k < pieces; ++k) extend(path.at(m, static_cast<double>(k) / pieces));
    }
    return box;
}

class Fit {
public:
    Fit(const Toolpath& path, std::vector<PathSample> samples, double tolerance)
        : path_(path), samples_(std::move(samples)), near_(std::min(most_near, near + 2 * tolerance)) {
        for (const PathSample& sample : samples_) centre_ += sample.position / static_cast<double>(samples_.size());
        double square = 0;
        for (const PathSample& sample : samples_) square += (sample.position - centre_).head<2>().squaredNorm();
        rim_ = std::sqrt(square / static_cast<double>(samples_.size()));
    }

    /// Refines the guess; none if too few points are near, or a direction is not determined.
    std::optional<Eigen::Isometry3d> refine(Eigen::Isometry3d pose, bool turns) {
        for (int round = 0; round < most_rounds; ++round) {
            project(pose);
            if (static_cast<double>(residuals_.size()) < found_share * static_cast<double>(samples_.size()))
                return std::nullopt;
            const Eigen::Vector4d step = solve(pose * centre_, turns);
            if (!step.allFinite()) return std::nullopt;
            const Vec3 about = pose * centre_;
            pose = Eigen::Translation3d(step.head<3>() + about) * Eigen::AngleAxisd(step[3], Vec3::UnitZ()) *
                   Eigen::Translation3d(-about) * pose;
            if (step.head<3>().norm() + std::abs(step[3]) * rim_ < settled) break;
        }
        return pose;
    }
    /// As refine(), without a negligible rotation.
    std::optional<Eigen::Isometry3d> refine(const Eigen::Isometry3d& guess) {
        const std::optional<Eigen::Isometry3d> turned = refine(guess, true);
        if (turned && std::abs(turn_of(*turned)) * rim_ > least_turn) return turned;
        Eigen::Isometry3d shifted =
            Eigen::Isometry3d(Eigen::Translation3d((turned ? *turned : guess) * centre_ - centre_));
        if (!turned && std::abs(turn_of(guess)) * rim_ > least_turn) shifted = guess;
        return refine(shifted, false);
    }

    [[nodiscard]] bool fits(const Eigen::Isometry3d& pose) {
        return share(pose) >= near_share && typical_distance() <= near;
    }
    [[nodiscard]] double share(const Eigen::Isometry3d& pose) {
        project(pose);
        const auto good = std::count_if(residuals_.begin(), residuals_.end(),
                                        [&](const Residual& r) { return r.off.squaredNorm() <= near_ * near_; });
        return static_cast<double>(good) / static_cast<double>(samples_.size());
    }
    /// Mean of the nearer half of the distances of the last pose [mm].
    [[nodiscard]] double typical_distance() const {
        std::vector<double> distances;
        for (const Residual& r : residuals_) distances.push_back(r.off.norm());
        if (distances.empty()) return std::numeric_limits<double>::infinity();
        return median(distances);
    }
    /// Distance of the part in two poses [mm].
    [[nodiscard]] double apart(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const {
        return (a * centre_ - b * centre_).norm() + std::abs(turn_of(a.inverse() * b)) * rim_;
    }
    static double turn_of(const Eigen::Isometry3d& pose) {
        return std::atan2(pose.linear()(1, 0), pose.linear()(0, 0));
    }

private:
    /// Vector from the moved point to its projection, the motion's direction there (zero at its ends), and the point.
    struct Residual {
        Vec3 off, direction, point;
    };

    void project(const Eigen::Isometry3d& pose) {
        residuals_.clear();
        for (const PathSample& sample : samples_) {
            const Vec3 p = pose * sample.position;
            Projection best{std::numeric_limits<double>::infinity(), 0};
            std::int64_t at = -1;
            const auto consider = [&](std::int64_t m) {
                const Projection projection = path_.projection(m, p);
                if (!(projection.distance < best.distance)) return;
                best = projection;
                at = m;
            };
            if (sample.motions.last < sample.motions.first) {
                if (!grid_) grid_.emplace(path_);
                for (const std::int64_t m : grid_->near(p, std::max(reach, near_))) consider(m);
            } else {
                for (std::int64_t m = sample.motions.first; m <= sample.motions.last; ++m) consider(m);
            }
            if (at < 0) continue;
            const Vec3 projection = path_.at(at, best.fraction);
            constexpr double ahead = 1e-4;  // of the motion's arc length
            Vec3 direction = Vec3::Zero();
            if (best.fraction > 0 && best.fraction < 1) {
                direction = (path_.at(at, std::min(1.0, best.fraction + ahead)) -
                             path_.at(at, std::max(0.0, best.fraction - ahead)))
                                .normalized();
            }
            residuals_.push_back({projection - p, direction, p});
        }
    }

    /// Weighted least squares perpendicular to the directions; weights decrease with the distance over its median.
    /// Shift [mm], and rotation about Z through `centre` [rad]; NaN: a direction is not determined.
    [[nodiscard]] Eigen::Vector4d solve(const Vec3& centre, bool turns) const {
        std::vector<double> distances;
        for (const Residual& r : residuals_) distances.push_back((r.off - r.direction.dot(r.off) * r.direction).norm());
        std::vector<double> sorted = distances;
        const double scatter = std::max(least_scatter, median(sorted));
        Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
        Eigen::Vector4d right = Eigen::Vector4d::Zero();
        double weights = 0;
        for (std::size_t i = 0; i < residuals_.size(); ++i) {
            const Residual& r = residuals_[i];
            const double ratio = distances[i] / scatter;
            const double weight = 1 / (1 + ratio * ratio);
            const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - r.direction * r.direction.transpose();
            Eigen::Matrix<double, 3, 4> moves;  // of the point, by shift and by rotation at the rim
            moves.leftCols<3>().setIdentity();
            const Vec3 arm = r.point - centre;
            moves.col(3) = Vec3(-arm.y(), arm.x(), 0) / std::max(rim_, least_scatter);
            normal += weight * (moves.transpose() * across * moves);
            right += weight * (moves.transpose() * (across * r.off));
            weights += weight;
        }
        if (!turns) {
            normal.row(3).setZero();
            normal.col(3).setZero();
            normal(3, 3) = weights;
            right[3] = 0;
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(normal);
        if (!(eigen.eigenvalues()[0] > determined * weights))
            return Eigen::Vector4d::Constant(std::numeric_limits<double>::quiet_NaN());
        Eigen::Vector4d step = normal.ldlt().solve(right);
        step[3] /= std::max(rim_, least_scatter);
        return step;
    }

    const Toolpath& path_;
    std::vector<PathSample> samples_;
    double near_;
    Vec3 centre_ = Vec3::Zero();
    double rim_ = 0;  ///< [mm] root mean square distance from the centre, in plan
    std::optional<MotionGrid> grid_;
    std::vector<Residual> residuals_;
};

/// The pose that most line changes agree with: pairs that are far apart give hypotheses, and the others vote.
std::optional<Eigen::Isometry3d> guess_from_changes(const std::vector<PointPair>& pairs, double tolerance) {
    if (pairs.size() < least_changes) return std::nullopt;
    Box3 box;
    for (const PointPair& pair : pairs) box.extend(pair.program);
    const double apart = 0.2 * box.diagonal().norm();
    const double reach_of_pair = pair_tolerance + 2 * std::min(tolerance, most_near);
    std::minstd_rand random(1);
    std::uniform_int_distribution<std::size_t> any(0, pairs.size() - 1);
    std::vector<PointPair> most_agreeing, agreeing;
    for (std::size_t k = 0; k < hypotheses; ++k) {
        const PointPair &a = pairs[any(random)], &b = pairs[any(random)];
        const Vec2 displacement = (b.program - a.program).head<2>(), logged = (b.log - a.log).head<2>();
        if (displacement.norm() < apart || std::abs(displacement.norm() - logged.norm()) > reach_of_pair) continue;
        const Eigen::Isometry3d pose = pose_of_pairs({a, b});
        agreeing.clear();
        for (const PointPair& pair : pairs) {
            if ((pose * pair.log - pair.program).norm() < reach_of_pair) agreeing.push_back(pair);
        }
        if (agreeing.size() > most_agreeing.size()) std::swap(agreeing, most_agreeing);
    }
    if (2 * most_agreeing.size() < pairs.size()) return std::nullopt;
    return pose_of_pairs(most_agreeing);
}

std::vector<Vec3> guesses_from_boxes(const Box3& program, const Box3& log) {
    std::vector<Vec3> guesses;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 guess;
        for (int axis = 0; axis < 3; ++axis) {
            guess[axis] = (corner >> axis & 1) == 0 ? program.min()[axis] - log.min()[axis]
                                                    : program.max()[axis] - log.max()[axis];
        }
        const bool new_one = std::none_of(guesses.begin(), guesses.end(),
                                          [&](const Vec3& g) { return (g - guess).norm() < same_shift; });
        if (new_one && guess.allFinite()) guesses.push_back(guess);
    }
    return guesses;
}

/// To a micrometre, or a ten-thousandth of a degree, the resolution of offsets: "12.5", "-3".
std::string decimals(double value, int digits) {
    std::string text = fixed_text(value, digits);
    text.resize(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

/// The poses that fit; several if they fit equally well. The nearest first.
std::vector<Eigen::Isometry3d> best_of(const std::vector<Eigen::Isometry3d>& guesses, Fit& fit) {
    struct Fitting {
        Eigen::Isometry3d pose;
        double share, distance;
    };
    std::vector<Fitting> fitting;
    double most = 0;
    for (const Eigen::Isometry3d& guess : guesses) {
        const std::optional<Eigen::Isometry3d> refined = fit.refine(guess);
        if (!refined || !fit.fits(*refined)) continue;
        const double share = fit.share(*refined);
        fitting.push_back({*refined, share, std::max(least_scatter, fit.typical_distance())});
        most = std::max(most, share);
    }
    std::erase_if(fitting, [&](const Fitting& f) { return f.share < most - more_points; });
    std::stable_sort(fitting.begin(), fitting.end(),
                     [](const Fitting& a, const Fitting& b) { return a.distance < b.distance; });
    std::vector<Eigen::Isometry3d> best;
    for (const Fitting& f : fitting) {
        if (f.distance > fitting.front().distance * far_better) break;
        const bool known = std::any_of(best.begin(), best.end(), [&](const Eigen::Isometry3d& other) {
            return fit.apart(other, f.pose) <= same_shift;
        });
        if (!known) best.push_back(f.pose);
    }
    return best;
}

/// Coordinates before the program sets them are unknown: such motions have no points.
Toolpath known_path(const Program& program) {
    return {program.motions, Vec3::Constant(std::numeric_limits<double>::quiet_NaN())};
}

}  // namespace

namespace {

std::vector<Eigen::Isometry3d> find_with(const Trajectory& path, const Program& program, const LineMap* map,
                                         std::vector<Eigen::Isometry3d> by_order, int system = 0) {
    const Toolpath toolpath = known_path(program);
    PathSamples samples = take_samples(path, toolpath, map, system);
    if (samples.points.size() < least_samples) return {};
    const double tolerance = corner_tolerance(program);
    Fit fit(toolpath, std::move(samples.points), tolerance);
    if (const std::optional<Eigen::Isometry3d> guess = guess_from_changes(samples.at_changes, tolerance)) {
        if (std::vector<Eigen::Isometry3d> found = best_of({*guess}, fit); !found.empty()) return found;
    }
    std::vector<Eigen::Isometry3d> found = best_of(by_order, fit);
    if (found.size() == 1) return found;
    for (const Vec3& shift : guesses_from_boxes(box_of(toolpath), box_of(path)))
        by_order.emplace_back(Eigen::Translation3d(shift));
    return best_of(by_order, fit);
}

}  // namespace

std::vector<Eigen::Isometry3d> find_poses(const Trajectory& path, const Program& program, const LineMap* map) {
    if (path.count == 0 || program.motions.size() == 0) return {};
    std::vector<Eigen::Isometry3d> by_order;
    const PathProfile of_program = profile_of(known_path(program), profile_points);
    if (of_program.size() > 1) by_order = guess_poses(of_program, profile_of(path, of_program.spacing));
    std::vector<Eigen::Isometry3d> by_lines;
    if (map != nullptr) by_lines = find_with(path, program, map, by_order);
    if (by_lines.size() == 1) return by_lines;
    std::vector<Eigen::Isometry3d> by_geometry = find_with(path, program, nullptr, by_order);
    return by_geometry.empty() ? by_lines : by_geometry;
}

double share_on_path(const Trajectory& path, const Program& program) {
    const Toolpath toolpath = known_path(program);
    PathSamples samples = take_samples(path, toolpath, nullptr);
    if (samples.points.empty()) return 0;
    return Fit(toolpath, std::move(samples.points), corner_tolerance(program)).share(Eigen::Isometry3d::Identity());
}

std::string pose_numbers(const Eigen::Isometry3d& pose) {
    const Vec3 t = pose.translation();
    const std::string turn = decimals(Fit::turn_of(pose) * deg_per_rad, 4);
    return fmt::format("{},{},{}", decimals(t.x(), 3), decimals(t.y(), 3), decimals(t.z(), 3)) +
           (turn == "0" ? "" : "," + turn);
}

namespace {

/// If the program cuts in several systems that it does not set, each has a pose of its own, from the lines of the
/// log.
bool note_systems(const Trajectory& path, const Program& program, const LineMap& map, Diagnostics& diagnostics) {
    const std::vector<int> systems = unknown_systems(program.motions);
    if (systems.size() < 2) return false;
    std::string options;
    std::vector<std::string> names;
    for (const int system : systems) {
        const auto found = find_with(path, program, &map, {}, system);
        if (found.size() != 1) return false;
        const Motions& motions = program.motions;
        const auto first = std::find_if(motions.frame.begin(), motions.frame.end(),
                                        [&](std::uint32_t frame) { return motions.frames[frame].system == system; });
        const bool leads = system == systems.front();
        Eigen::Isometry3d pose = path.pose() * found.front().inverse();
        if (!leads && first != motions.frame.end()) pose = pose * motions.frames[*first].placed;
        const std::string& name = names.emplace_back(name_of_work_system(system, program.dialect));
        options += leads ? "--work-offset " + pose_numbers(pose)
                         : fmt::format(" --work-offset {}:{}", name, pose_numbers(pose));
    }
    diagnostics.add(
        {Severity::warning, "map.work-offset", Place::of_file(path.name),
         fmt::format("the positions are parallel to the programmed path; those of {} have different offsets",
                     listed(names)),
         options + " aligns them"});
    return true;
}

}  // namespace

namespace {

void note_alike(const Trajectory& path, const std::vector<Eigen::Isometry3d>& poses, Diagnostics& diagnostics) {
    constexpr std::size_t shown = 4;
    std::string options;
    for (std::size_t k = 0; k < std::min(shown, poses.size()); ++k)
        options += (k == 0 ? "" : " or ") + pose_numbers(path.pose() * poses[k].inverse());
    diagnostics.add(
        {Severity::warning, "map.work-offset", Place::of_file(path.name),
         fmt::format("the work offset is ambiguous: the positions fit the programmed path equally well at {} places",
                     poses.size()),
         fmt::format("--work-offset {}: choose it by the machine's zero", options)});
}

}  // namespace

bool note_pose(const Trajectory& path, const Program& program, const LineMap* map, Diagnostics& diagnostics) {
    if (map != nullptr && note_systems(path, program, *map, diagnostics)) return true;
    const std::vector<Eigen::Isometry3d> poses = find_poses(path, program, map);
    if (poses.size() > 1) {
        note_alike(path, poses, diagnostics);
        return true;
    }
    if (poses.empty()) return false;
    const Eigen::Isometry3d* found = &poses.front();
    constexpr double least_shift = 1e-3;  // [mm] with a smaller shift, the points are off for another reason
    const std::string turn = decimals(-Fit::turn_of(*found) * deg_per_rad, 4);
    if (turn == "0" && found->translation().norm() < least_shift) return false;
    const Eigen::Isometry3d pose = path.pose() * found->inverse();
    std::string how = "displaced";
    Vec3 by = -found->translation();
    if (turn != "0") {
        how = fmt::format("turned by {} deg about Z, and displaced", turn);
        by = found->inverse().translation();
    }
    // Rounded corners are inside the programmed ones: the best fit is off by a part of that.
    const double tolerance = corner_tolerance(program);
    const std::string known_to =
        tolerance > near ? fmt::format("; its corners may be rounded by {} mm, which limits the accuracy of the shift",
                                       decimals(tolerance, 3))
                         : "";
    diagnostics.add({Severity::warning, "map.work-offset", Place::of_file(path.name),
                     fmt::format("the positions are parallel to the programmed path, {} by X {} Y {} Z {} mm{}", how,
                                 decimals(by.x(), 3), decimals(by.y(), 3), decimals(by.z(), 3), known_to),
                     fmt::format("--work-offset {} aligns them", pose_numbers(pose))});
    return true;
}

}  // namespace clsurf
