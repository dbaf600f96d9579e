#include "path/work_offset.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Dense>

#include "core/block.h"
#include "core/statistics.h"
#include "path/allowed_motions.h"
#include "path/motion_grid.h"
#include "path/toolpath.h"

namespace clsurf {
namespace {

constexpr PointIndex stretches = 64;  ///< evenly spaced over the log
constexpr PointIndex stretch = 1600;  ///< points
constexpr std::size_t samples_of_stretch = 24;
constexpr std::size_t least_samples = 100;
constexpr std::size_t least_changes = 10;  ///< of the line, for a first guess from them
constexpr double near = 0.05;              ///< [mm] on the path: a corner tolerance of finishing
constexpr double near_share = 0.9;
constexpr double found_share = 0.5;  ///< a guess that has this part of the points in reach is refined
constexpr double reach = 0.5;        ///< [mm] the grid's cells are at least this large
constexpr double same_shift = 0.02;  ///< [mm]
constexpr int most_rounds = 30;
constexpr double settled = 1e-5;        ///< [mm]
constexpr double least_scatter = 1e-3;  ///< [mm] residuals below count the same
constexpr double determined = 1e-3;     ///< of the points' directions, in the weakest direction

/// A moving point and where it may lie.
struct Sample {
    Vec3 position;
    MotionRange motions;  ///< empty: anywhere
};

struct Samples {
    std::vector<Sample> points;
    std::array<std::vector<double>, 3> at_changes;  ///< end of a line minus the position there, by axis
};

Samples take_samples(const Trajectory& path, const Toolpath& toolpath, const LineMap* map) {
    Samples samples;
    const PointIndex n = std::min(path.count, stretch);
    const PointIndex count = std::min(stretches, path.count / n);
    std::vector<double> x(static_cast<std::size_t>(n)), y(x.size()), z(x.size());
    std::vector<LineNumber> lines(x.size(), 0);
    const std::size_t every = std::max<std::size_t>(
        1, x.size() * static_cast<std::size_t>(count) / (static_cast<std::size_t>(stretches) * samples_of_stretch));
    for (PointIndex s = 0; s < count; ++s) {
        const PointIndex begin = count == 1 ? 0 : (path.count - n) / (count - 1) * s;
        path.read(begin, x, y, z);
        if (map != nullptr) map->read(begin, lines);
        std::int64_t before = -1;
        bool known = map == nullptr || begin == 0;
        std::size_t moving = 0;
        for (std::size_t i = 1; i < x.size(); ++i) {
            const Vec3 p(x[i], y[i], z[i]);
            const Vec3 last(x[i - 1], y[i - 1], z[i - 1]);
            if (map != nullptr && lines[i] != lines[i - 1]) {
                before = map->motion_at(begin + static_cast<PointIndex>(i) - 1);
                known = true;
                const std::span<const std::uint32_t> ended = map->motions_of(lines[i - 1]);
                if (ended.size() == 1 && last.allFinite()) {
                    const Vec3 off = toolpath.end(ended.front()) - last;
                    for (int axis = 0; axis < 3; ++axis)
                        samples.at_changes[static_cast<std::size_t>(axis)].push_back(off[axis]);
                }
            }
            if (!p.allFinite() || !((p - last).squaredNorm() > 0) || !known || (map != nullptr && lines[i] == 0))
                continue;
            if (moving++ % every != 0) continue;
            Sample sample{p, {0, -1}};
            if (map != nullptr) {
                const std::int64_t motion = map->motion_at(begin + static_cast<PointIndex>(i));
                if (motion < 0) continue;
                const MotionRange range = allowed_motions(before, motion, toolpath.size());
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
        if (!is_arc(path.motions().kind[static_cast<std::size_t>(m)])) continue;
        for (int k = 0; k < pieces; ++k) extend(path.at(m, static_cast<double>(k) / pieces));
    }
    return box;
}

Box3 box_of(const Trajectory& path) {
    std::vector<Box3> boxes(static_cast<std::size_t>((path.count + block_points - 1) / block_points));
    for_each_block(path.count, [&](PointIndex first, PointIndex last) {
        std::vector<double> x(static_cast<std::size_t>(last - first)), y(x.size()), z(x.size());
        path.read(first, x, y, z);
        Box3& box = boxes[static_cast<std::size_t>(first / block_points)];
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Vec3 p(x[i], y[i], z[i]);
            if (p.allFinite()) box.extend(p);
        }
    });
    Box3 all;
    for (const Box3& box : boxes) all.extend(box);
    return all;
}

class Fit {
public:
    Fit(const Toolpath& path, std::vector<Sample> samples) : path_(path), samples_(std::move(samples)) {}

    /// The guess made better; none where too few points come near, or a direction is not determined.
    std::optional<Vec3> refine(Vec3 shift) {
        for (int round = 0; round < most_rounds; ++round) {
            find_feet(shift);
            if (static_cast<double>(residuals_.size()) < found_share * static_cast<double>(samples_.size()))
                return std::nullopt;
            const Vec3 step = solve();
            if (!step.allFinite()) return std::nullopt;
            shift += step;
            if (step.norm() < settled) break;
        }
        return shift;
    }

    [[nodiscard]] bool fits(const Vec3& shift) {
        find_feet(shift);
        const auto good = std::count_if(residuals_.begin(), residuals_.end(),
                                        [](const Residual& r) { return r.off.squaredNorm() <= near * near; });
        return static_cast<double>(good) >= near_share * static_cast<double>(samples_.size());
    }

private:
    /// From the shifted point to its foot, and the motion's direction there (zero at its ends).
    struct Residual {
        Vec3 off, direction;
    };

    void find_feet(const Vec3& shift) {
        residuals_.clear();
        for (const Sample& sample : samples_) {
            const Vec3 p = sample.position + shift;
            Foot best{std::numeric_limits<double>::infinity(), 0};
            std::int64_t at = -1;
            const auto consider = [&](std::int64_t m) {
                const Foot foot = path_.foot(m, p);
                if (!(foot.distance < best.distance)) return;
                best = foot;
                at = m;
            };
            if (sample.motions.last < sample.motions.first) {
                if (!grid_) grid_.emplace(path_);
                for (const std::int64_t m : grid_->near(p, reach)) consider(m);
            } else {
                for (std::int64_t m = sample.motions.first; m <= sample.motions.last; ++m) consider(m);
            }
            if (at < 0) continue;
            const Vec3 foot = path_.at(at, best.fraction);
            constexpr double ahead = 1e-4;  // of the motion's way
            Vec3 direction = Vec3::Zero();
            if (best.fraction > 0 && best.fraction < 1) {
                direction = (path_.at(at, std::min(1.0, best.fraction + ahead)) -
                             path_.at(at, std::max(0.0, best.fraction - ahead)))
                                .normalized();
            }
            residuals_.push_back({foot - p, direction});
        }
    }

    /// Weighted least squares across the directions; weights fall with the distance over its median.
    [[nodiscard]] Vec3 solve() const {
        std::vector<double> distances;
        for (const Residual& r : residuals_) distances.push_back((r.off - r.direction.dot(r.off) * r.direction).norm());
        std::vector<double> sorted = distances;
        const double scatter = std::max(least_scatter, median(sorted));
        Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
        Vec3 right = Vec3::Zero();
        double weights = 0;
        for (std::size_t i = 0; i < residuals_.size(); ++i) {
            const Vec3& d = residuals_[i].direction;
            const double ratio = distances[i] / scatter;
            const double weight = 1 / (1 + ratio * ratio);
            const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - d * d.transpose();
            normal += weight * across;
            right += weight * (across * residuals_[i].off);
            weights += weight;
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(normal);
        if (!(eigen.eigenvalues()[0] > determined * weights))
            return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
        return normal.ldlt().solve(right);
    }

    const Toolpath& path_;
    std::vector<Sample> samples_;
    std::optional<MotionGrid> grid_;
    std::vector<Residual> residuals_;
};

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

}  // namespace

std::optional<Vec3> find_shift(const Trajectory& path, const Program& program, const LineMap* map) {
    if (path.count == 0 || program.motions.size() == 0) return std::nullopt;
    // Coordinates before the program sets them: unknown, and no motion to lie on.
    const Toolpath toolpath(program.motions, Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
    Samples samples = take_samples(path, toolpath, map);
    if (samples.points.size() < least_samples) return std::nullopt;
    std::vector<Vec3> guesses;
    if (samples.at_changes[0].size() >= least_changes) {
        Vec3 guess;
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<double>& off = samples.at_changes[static_cast<std::size_t>(axis)];
            std::erase_if(off, [](double v) { return !std::isfinite(v); });
            guess[axis] = off.empty() ? std::numeric_limits<double>::quiet_NaN() : median(off);
        }
        if (guess.allFinite()) guesses.push_back(guess);
    }
    if (guesses.empty()) guesses = guesses_from_boxes(box_of(toolpath), box_of(path));
    Fit fit(toolpath, std::move(samples.points));
    std::optional<Vec3> found;
    for (const Vec3& guess : guesses) {
        const std::optional<Vec3> refined = fit.refine(guess);
        if (!refined || !fit.fits(*refined)) continue;
        if (found && (*found - *refined).norm() > same_shift) return std::nullopt;
        if (!found) found = refined;
    }
    return found;
}

}  // namespace clsurf
