#include "measured/align.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "core/error.h"
#include "core/not_finite.h"
#include "core/statistics.h"
#include "core/units.h"
#include "measured/pose_search.h"

namespace clsurf {
namespace {

constexpr std::size_t most_fitted = 5000;   ///< points; more do not improve the pose beyond the accuracy of the surface
constexpr std::size_t most_searched = 600;  ///< points
// usual_search, search_passes, search_steps, surface_error, much_farther, fewest_each, above_scatter, far_above_scatter:
// docs/howto/measured.md#the-pose.
constexpr double usual_search = 1;      ///< [mm]
constexpr double search_passes = 3;     ///< step-overs
constexpr double search_steps = 8;      ///< steps per step-over
constexpr double same_place = 0.25;     ///< step-overs: poses closer than this are the same
constexpr double surface_error = 5e-5;  ///< [mm] error of heights between cells: lower limit of any error
constexpr double most_error = 0.25;     ///< step-overs: largest standard error of a determined degree of freedom
constexpr double much_farther = 1.25;   ///< times the least median distance: such a pose is unlikely
// By chance: chi-square with one degree of freedom exceeds 12 with a probability of 0.0005.
constexpr double clear_difference = 12;   ///< difference of squares over their variance: less than 1 in 1,000 by chance
constexpr double clear_share = 0.2;       ///< share of the squares of points that are far off in both poses
constexpr double far_off = 4.5;           ///< median distances: three standard deviations; 3 · 1.4826
constexpr double least_far_off = 2e-4;    ///< [mm]
constexpr double unknown_error = 1e6;     ///< [mm] for a degree of freedom that changes no distance
constexpr double main_share = 0.4;        ///< share of a direction's length: a smaller component is not named
constexpr std::size_t fewest_each = 4;    ///< points for each degree of freedom that scallops determine
constexpr double above_scatter = 3;       ///< ratio of rms to scatter from which on a profile may be misplaced
constexpr double far_above_scatter = 10;  ///< … and the ratio that scatter does not explain

std::size_t known_points(const MeasuredData& measured) {
    return measured.points.size() - (measured.kind == MeasuredKind::areal ? measured.missing : 0);
}

/// All measured points, or `most` of them, evenly thinned.
std::vector<Vec3> some_of(const MeasuredData& measured, std::size_t most) {
    const double stride = std::max(1.0, static_cast<double>(known_points(measured)) / static_cast<double>(most));
    std::vector<Vec3> found;
    double next = 0;
    std::size_t number = 0;
    for (const Vec3& p : measured.points) {
        if (!std::isfinite(p.z())) continue;
        if (static_cast<double>(number++) < next) continue;
        found.push_back(p);
        next += stride;
    }
    return found;
}

Box2 region_of(std::span<const Vec3> points, const Pose& pose, double beside) {
    Box2 box;
    for (const Vec3& p : points) box.extend(Vec2(pose(p).head<2>()));
    const Vec2 room = Vec2::Constant(beside);
    return {box.min() - room, box.max() + room};
}

/// The number of neighbouring points with correlated scatter: the sum of squares of the sums of residuals over cells of a
/// step-over, relative to that of independent residuals.
double correlated_points(std::span<const Vec3> points, const FittedPose& fit, const PoseFit& by, double step_over) {
    std::map<std::pair<std::int64_t, std::int64_t>, double> sums;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double distance = fit.distances.along_normal[i];
        if (!std::isfinite(distance) || by.is_left_out(i)) continue;
        const Vec3 p = fit.pose(points[i]) / step_over;
        sums[{static_cast<std::int64_t>(std::floor(p.x())), static_cast<std::int64_t>(std::floor(p.y()))}] += distance;
    }
    double squares = 0;
    for (const auto& [cell, sum] : sums) squares += sum * sum;
    return fit.distances.squares > 0 ? std::max(1.0, squares / fit.distances.squares) : 1.0;
}

/// Scatter [mm] from one point to the next; independent of errors of the form and of the prediction.
double scatter_of(const FittedPose& fit, const PoseFit& by) {
    std::vector<double> steps;
    const std::vector<double>& distances = fit.distances.along_normal;
    for (std::size_t i = 1; i < distances.size(); ++i) {
        const bool used = !by.is_left_out(i - 1) && !by.is_left_out(i);
        if (used && std::isfinite(distances[i - 1]) && std::isfinite(distances[i]))
            steps.push_back(distances[i] - distances[i - 1]);
    }
    return steps.empty() ? 0 : robust_spread(steps).deviation / std::sqrt(2.0);
}

/// Variance [mm²] of one independent point.
double variance_of(const FittedPose& fit, std::size_t unknowns, double correlated) {
    const auto known = static_cast<double>(fit.distances.known);
    const double spare = std::max(1.0, known / correlated - static_cast<double>(unknowns)) * correlated;
    return std::max(fit.distances.squares / spare, surface_error * surface_error);
}

std::size_t known_of(const FittedPose& fit) { return fit.distances.known_ones().size(); }

/// Squares of all points with a distance, each limited to that of `most` [mm], because it does not matter how far off a missing
/// mark or dirt is. `cut`: the share of the limited squares.
struct CutSquares {
    double sum = 0, cut = 0;
};
CutSquares cut_squares(const FittedPose& fit, double most) {
    CutSquares squares;
    for (const double distance : fit.distances.known_ones()) {
        squares.sum += std::min(distance * distance, most * most);
        if (std::abs(distance) > most) squares.cut += most * most;
    }
    return squares;
}

double middle_distance(const FittedPose& fit) {
    std::vector<double> known = fit.distances.known_ones();
    for (double& distance : known) distance = std::abs(distance);
    return known.empty() ? infinite : median(known);
}

/// Describes the direction of one degree of freedom, or of several together.
std::string words_for(const PoseInformation& information, const Eigen::VectorXd& direction) {
    std::string words;
    for (Eigen::Index k = 0; k < direction.size(); ++k) {
        if (std::abs(direction[k]) < main_share) continue;
        const auto axis = static_cast<std::size_t>(information.axes[static_cast<std::size_t>(k)]);
        constexpr std::string_view axes = "xyz";
        if (!words.empty()) words += " with ";
        words += fmt::format("{} {}", axis < 3 ? "the shift along" : "the rotation about", axes[axis % 3]);
    }
    return words;
}

class Aligner {
public:
    Aligner(const MeasuredData& measured, const AsMachinedSurface& as_machined, const AlignRules& rules)
        : as_machined_(as_machined),
          kind_(measured.kind),
          step_over_(as_machined.surface().step_over),
          search_(rules.search > 0 ? rules.search : std::max(usual_search, search_passes * step_over_)),
          free_(rules.free.value_or(usual_free_axes(measured.kind))),
          points_(some_of(measured, most_fitted)),
          few_points_(some_of(measured, most_searched)),
          heights_(as_machined) {
        if (rules.start) {
            start_.turn = Eigen::AngleAxisd(rules.start->angle, Vec3::UnitZ()).toRotationMatrix();
            start_.shift = Vec3(rules.start->origin.x(), rules.start->origin.y(), 0);
        }
        lifted_ = start_;
        result_.points = known_points(measured);
    }

    Alignment run() {
        unknowns_ = static_cast<std::size_t>(std::count(free_.begin(), free_.end(), true));
        result_.pose = start_;
        if (points_.size() <= unknowns_) {
            result_.reasons.push_back(
                fmt::format("{} points cannot determine {} degrees of freedom", points_.size(), unknowns_));
            return result_;
        }
        // With too few points, the best of many starts would fit their scatter, and its errors would be far greater than
        // estimated.
        if (is_shifted() && points_.size() < fewest_each * unknowns_) {
            result_.reasons.push_back(
                fmt::format("{} points are too few for {} degrees of freedom on a surface with scallops: {} are needed",
                            points_.size(), unknowns_, fewest_each * unknowns_));
            return result_;
        }
        lift();
        const Form form(as_machined_, region_of(points_, lifted_, search_ + 2 * step_over_), Form::Of::contacts);
        // Points are given in the axes of the part, at least roughly. Other measurements begin where the start states.
        const double most_shift = kind_ == MeasuredKind::points ? infinite : search_ + step_over_;
        PoseFit coarse(few_points_, heights_, form, lifted_, free_, step_over_, most_shift);
        PoseFit fine(points_, heights_, form, lifted_, free_, step_over_, most_shift);
        const FittedPose led = coarse.fit_form(lifted_);
        if (2 * led.distances.known < few_points_.size()) {
            result_.reasons.push_back(fmt::format(
                "only {} of {} points lie over the finished part: the start is wrong, or another part was measured",
                led.distances.known, few_points_.size()));
            return result_;
        }
        std::vector<FittedPose> found;
        for (const Pose& pose : first_poses(led)) found.push_back(fine.fit_without_outliers(pose));
        choose(found, fine);
        return result_;
    }

private:
    /// Heights of a profile or a map have no common zero with the part: shifts them to the surface.
    void lift() {
        if (!free_[static_cast<std::size_t>(PoseAxis::z)]) return;
        std::vector<Vec2> places(few_points_.size());
        for (std::size_t i = 0; i < places.size(); ++i) places[i] = lifted_(few_points_[i]).head<2>();
        heights_.prepare(places, step_over_);
        std::vector<double> off;
        for (std::size_t i = 0; i < places.size(); ++i) {
            const double z = heights_.at(places[i]);
            if (std::isfinite(z)) off.push_back(z - lifted_(few_points_[i]).z());
        }
        if (!off.empty()) lifted_.shift.z() += median(off);
    }

    /// Whether points may be shifted along the surface, where they may also fit one step-over away from the right place.
    [[nodiscard]] bool is_shifted() const {
        return free_[static_cast<std::size_t>(PoseAxis::x)] || free_[static_cast<std::size_t>(PoseAxis::y)];
    }

    /// The start poses of fits to the surface with its scallops.
    std::vector<Pose> first_poses(const FittedPose& led) {
        std::vector<Pose> found{led.pose};
        if (!is_shifted()) return found;
        const double step = step_over_ / search_steps;
        const auto steps = static_cast<std::int64_t>(std::ceil(search_ / step));
        PoseSearch search(few_points_, heights_, start_.turn, free_);
        // A measurement with a stated start is searched there, because a form with hardly any features may mislead the fit.
        const std::vector<Pose> best = search.around(kind_ == MeasuredKind::points ? led.pose : lifted_, step, steps);
        found.insert(found.end(), best.begin(), best.end());
        return found;
    }

    /// Selects the best pose, and checks whether it is the only one.
    void choose(std::vector<FittedPose>& found, PoseFit& fine) {
        std::size_t most = 0;
        for (const FittedPose& fit : found) most = std::max(most, known_of(fit));
        std::erase_if(found, [&](const FittedPose& fit) { return 10 * known_of(fit) < 9 * most; });
        // The median distance separates wrong places from right ones even if a mark is missing.
        double least = infinite;
        for (const FittedPose& fit : found) least = std::min(least, middle_distance(fit));
        const double likely = std::max(much_farther * least, surface_error);
        std::erase_if(found, [&](const FittedPose& fit) { return middle_distance(fit) > likely; });
        const double most_off = std::max(far_off * least, least_far_off);
        std::stable_sort(found.begin(), found.end(), [&](const FittedPose& a, const FittedPose& b) {
            return cut_squares(a, most_off).sum < cut_squares(b, most_off).sum;
        });
        const FittedPose best = fine.fit_without_outliers(found.front().pose);
        result_.pose = best.pose;
        result_.used = best.distances.known;
        result_.left_out = points_.size() - result_.used;
        result_.rms = std::sqrt(best.distances.mean_square());
        for (const double distance : best.distances.along_normal) {
            if (std::abs(distance) > std::abs(result_.worst)) result_.worst = distance;
        }
        if (kind_ != MeasuredKind::points) result_.scatter = scatter_of(best, fine);
        result_.correlated = correlated_points(points_, best, fine, step_over_);
        const double variance = variance_of(best, unknowns_, result_.correlated);
        judge(fine.information(best.pose), variance, fine);
        find_rivals(found, most_off, variance, fine);
    }

    /// Whether another pose fits as well as the best one. A measured mark distinguishes poses; a missing one causes the same
    /// error in every pose.
    void find_rivals(const std::vector<FittedPose>& found, double most_off, double variance, const PoseFit& fine) {
        const CutSquares best = cut_squares(found.front(), most_off);
        const double clear = std::max(clear_difference * variance, clear_share * best.cut);
        const Vec3 middle = fine.centre(result_.pose);
        for (const FittedPose& other : found) {
            const double apart = (fine.centre(other.pose) - middle).head<2>().norm();
            if (apart < same_place * step_over_ || cut_squares(other, most_off).sum - best.sum > clear) continue;
            result_.reasons.push_back(
                fmt::format("another pose, {:.3f} mm away, fits as well: {:.3f} µm rms against {:.3f} µm", apart,
                            std::sqrt(other.distances.mean_square()) * um_per_mm, result_.rms * um_per_mm));
            break;
        }
    }

    /// Standard errors, and the degrees of freedom that the surface does not constrain.
    void judge(const PoseInformation& information, double variance, const PoseFit& fine) {
        Eigen::MatrixXd held = information.normal;
        const double noise = static_cast<double>(result_.used) * information.slope_noise * information.slope_noise;
        for (Eigen::Index k = 0; k < held.rows(); ++k) {
            if (information.axes[static_cast<std::size_t>(k)] == PoseAxis::z) continue;
            held(k, k) -= noise;
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(held);
        const double most = most_error * step_over_;
        Eigen::VectorXd variances = Eigen::VectorXd::Zero(held.rows());
        for (Eigen::Index k = 0; k < held.rows(); ++k) {
            const double value = parts.eigenvalues()[k];
            const double error = value > 0 ? std::min(std::sqrt(variance / value), unknown_error) : unknown_error;
            variances += error * error * parts.eigenvectors().col(k).cwiseAbs2();
            if (error <= most) continue;
            result_.reasons.push_back(
                fmt::format("the surface does not determine {}", words_for(information, parts.eigenvectors().col(k))));
        }
        report(information, variances, fine);
    }

    void report(const PoseInformation& information, const Eigen::VectorXd& variances, const PoseFit& fine) {
        const Vec3 moved = start_.turn.transpose() * (fine.centre(result_.pose) - fine.centre(start_));
        const Eigen::AngleAxisd turned(Eigen::Matrix3d(start_.turn.transpose() * result_.pose.turn));
        const Vec3 turn = turned.angle() * turned.axis();
        for (std::size_t k = 0; k < pose_axes; ++k) {
            const bool rotation = k >= 3;
            PoseParameter parameter;
            parameter.axis = static_cast<PoseAxis>(k);
            parameter.fitted = free_[k];
            parameter.value = rotation ? turn[static_cast<Eigen::Index>(k) - 3] : moved[static_cast<Eigen::Index>(k)];
            const auto at = std::find(information.axes.begin(), information.axes.end(), parameter.axis);
            if (at != information.axes.end()) {
                const double variance = variances[at - information.axes.begin()];
                parameter.standard_error = std::sqrt(variance) / (rotation ? information.rotation_radius : 1.0);
            }
            result_.parameters.push_back(parameter);
        }
    }

    const AsMachinedSurface& as_machined_;
    MeasuredKind kind_;
    double step_over_;
    double search_;
    FreeAxes free_;
    std::vector<Vec3> points_, few_points_;
    PredictedHeights heights_;
    Pose start_;   ///< as stated
    Pose lifted_;  ///< with the points on the surface
    std::size_t unknowns_ = 0;
    Alignment result_;
};

bool is_above_scatter(const Alignment& alignment, double times) {
    return alignment.rms > times * std::max(alignment.scatter, surface_error);
}

/// Aligns along the profile, and if the residuals exceed the scatter, across it as well: at a wrong place a profile has another
/// form.
Alignment align_profile(const MeasuredData& measured, const AsMachinedSurface& as_machined, const AlignRules& rules) {
    Alignment stated = Aligner(measured, as_machined, rules).run();
    if (rules.free || !is_above_scatter(stated, above_scatter)) return stated;
    AlignRules across = rules;
    across.free = usual_free_axes(MeasuredKind::profile);
    (*across.free)[static_cast<std::size_t>(PoseAxis::y)] = true;
    Alignment moved = Aligner(measured, as_machined, across).run();
    return moved.determined() && much_farther * moved.rms < stated.rms ? moved : stated;
}

}  // namespace

std::optional<std::string> misfit_of(const Alignment& alignment) {
    if (!alignment.determined() || !(alignment.scatter > 0) || !is_above_scatter(alignment, far_above_scatter))
        return std::nullopt;
    return fmt::format(
        "the fit leaves {:.3f} µm rms, and neighbouring points scatter by {:.3f} µm: the start is farther off than was "
        "tried, or the part has another form than the log says; pose, depths and roughness may be wrong",
        alignment.rms * um_per_mm, alignment.scatter * um_per_mm);
}

FreeAxes usual_free_axes(MeasuredKind kind) {
    if (kind == MeasuredKind::profile) return {true, false, true, false, true, false};
    return {true, true, true, true, true, true};
}

std::string_view name_of(PoseAxis axis) {
    constexpr std::string_view names[] = {"x", "y", "z", "a", "b", "c"};
    return names[static_cast<std::size_t>(axis)];
}

Alignment align(const MeasuredData& measured, const AsMachinedSurface& as_machined, const AlignRules& rules) {
    if (measured.kind != MeasuredKind::points && !rules.start) {
        Alignment refused;
        refused.points = known_points(measured);
        refused.reasons.push_back(fmt::format("the {} does not say where on the part it begins and which way it runs",
                                              name_of(measured.kind)));
        return refused;
    }
    if (measured.kind == MeasuredKind::profile && rules.free) {
        const FreeAxes can = usual_free_axes(measured.kind);
        for (std::size_t k = 0; k < pose_axes; ++k) {
            if ((*rules.free)[k] && !can[k])
                throw UsageError(fmt::format("a profile does not determine {}: only x, z and b can be fitted",
                                             name_of(static_cast<PoseAxis>(k))));
        }
    }
    return measured.kind == MeasuredKind::profile ? align_profile(measured, as_machined, rules)
                                                  : Aligner(measured, as_machined, rules).run();
}

}  // namespace clsurf
