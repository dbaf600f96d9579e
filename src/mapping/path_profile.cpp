#include "mapping/path_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/block.h"

namespace clsurf {
namespace {

constexpr double least_step = 0.05;         ///< [mm] shorter steps of a log may be noise
constexpr std::size_t compared_most = 400;  ///< points of a log whose distances are compared
constexpr std::size_t least_points = 16;    ///< points of a log
constexpr double kept_share = 0.8;          ///< share of the pairs kept in a round
constexpr int pair_rounds = 5;
constexpr int follow_rounds = 6;
constexpr std::size_t followed_most = 1500;  ///< points of a log that are followed along the program
constexpr double window_share = 0.01;        ///< share of the program: how far a point may be from its expected place
constexpr std::size_t best_places = 6;       ///< places of the log on the program that are followed
constexpr double place_share = 0.005;        ///< share of the program: matches nearer to each other count as one place

/// Resamples a path that comes in pieces at equal distances.
class EvenPoints {
public:
    explicit EvenPoints(double spacing) { profile_.spacing = spacing; }

    void go_to(const Vec3& p) {
        if (profile_.points.empty()) {
            profile_.points.push_back(p);
            last_ = p;
            return;
        }
        double length = (p - last_).norm();
        while (length > 0 && walked_ + length >= profile_.spacing) {
            const double part = (profile_.spacing - walked_) / length;
            last_ += part * (p - last_);
            profile_.points.push_back(last_);
            length = (p - last_).norm();
            walked_ = 0;
        }
        walked_ += length;
        last_ = p;
    }
    [[nodiscard]] bool begun() const { return !profile_.points.empty(); }
    [[nodiscard]] const Vec3& last() const { return last_; }
    PathProfile take() { return std::move(profile_); }

private:
    PathProfile profile_;
    Vec3 last_ = Vec3::Zero();
    double walked_ = 0;
};

/// Distances between points of a path: invariant to shift and rotation.
struct Distances {
    std::vector<std::size_t> lags;
    std::vector<std::vector<float>> along;   ///< per lag: from each point to the one this much later
    std::vector<std::vector<float>> rising;  ///< the same along Z, which no pose rotates

    Distances(const PathProfile& profile, std::vector<std::size_t> given) : lags(std::move(given)) {
        for (const std::size_t lag : lags) {
            along.emplace_back();
            rising.emplace_back();
            for (std::size_t i = 0; i + lag < profile.size(); ++i) {
                const Vec3 displacement = profile.points[i + lag] - profile.points[i];
                along.back().push_back(static_cast<float>(displacement.norm()));
                rising.back().push_back(static_cast<float>(displacement.z()));
            }
        }
    }
};

/// A place of the log on the program: point k of the log corresponds to point first + k · scale.
struct Match {
    double first = 0, scale = 1;
    double cost = std::numeric_limits<double>::infinity();
};

double cost_of(const Distances& program, const Distances& log, double first, double scale, float most) {
    double cost = 0;
    std::size_t compared = 0, wanted = 0;
    for (std::size_t l = 0; l < log.lags.size(); ++l) {
        const std::vector<float>&mine = log.along[l], &its = program.along[l];
        const std::size_t stride = std::max<std::size_t>(1, mine.size() / compared_most);
        for (std::size_t k = 0; k < mine.size(); k += stride) {
            ++wanted;
            const double at = first + static_cast<double>(k) * scale;
            if (at < 0 || at >= static_cast<double>(its.size())) continue;
            const auto i = static_cast<std::size_t>(at);
            ++compared;
            cost += std::min(most, std::abs(mine[k] - its[i]) + std::abs(log.rising[l][k] - program.rising[l][i]));
        }
    }
    // Points outside the program count as a bad fit.
    return 2 * compared < wanted ? std::numeric_limits<double>::infinity()
                                 : (cost + most * static_cast<double>(wanted - compared)) / static_cast<double>(wanted);
}

/// The best matches at distinct places, best first. `apart`: of places [points].
std::vector<Match> best_of(std::vector<Match> matches, double apart) {
    std::erase_if(matches, [](const Match& a) { return !std::isfinite(a.cost); });
    std::stable_sort(matches.begin(), matches.end(), [](const Match& a, const Match& b) { return a.cost < b.cost; });
    std::vector<Match> best;
    for (const Match& one : matches) {
        const bool known = std::any_of(best.begin(), best.end(), [&](const Match& other) {
            return one.scale == other.scale && std::abs(one.first - other.first) < apart;
        });
        if (!known) best.push_back(one);
        if (best.size() == best_places) break;
    }
    return best;
}

std::vector<Match> match(const PathProfile& program, const PathProfile& log) {
    std::vector<std::size_t> lags;
    for (const std::size_t part : {300, 40, 8, 3}) {
        const std::size_t lag = std::max<std::size_t>(2, log.size() / part);
        if (lag + 4 < log.size() && lag + 4 < program.size() && (lags.empty() || lag != lags.back()))
            lags.push_back(lag);
    }
    const Distances of_program(program, lags), of_log(log, lags);
    const float most = static_cast<float>(20 * program.spacing);
    const auto n = static_cast<double>(program.size()), m = static_cast<double>(log.size());
    std::vector<Match> matches;
    const auto add = [&](double first, double scale) {
        matches.push_back({first, scale, cost_of(of_program, of_log, first, scale, most)});
    };
    const double step = std::max(1.0, std::floor(n / 8000));
    for (double first = -m / 2; first < n - m / 2; first += step) add(first, 1);
    // Passes that are alike fit adjacent passes nearly as well: each place counts once, else all of the first few
    // would be variants of the best one.
    const double one_place = std::max(2 * step, place_share * n);
    const std::vector<Match> coarse = best_of(std::move(matches), one_place);
    matches.clear();
    add(0, n / m);  // both complete
    for (const Match& place : coarse) {
        for (double fine = -step; fine <= step; fine += 1) add(place.first + fine, 1);
    }
    return best_of(std::move(matches), one_place);
}

/// Pairs along the match, refined alternately: the pose of the pairs, and for each point of the log the nearest point
/// of the program near its expected place.
Eigen::Isometry3d follow(const PathProfile& program, const PathProfile& log, const Match& found) {
    const std::size_t stride = std::max<std::size_t>(1, log.size() / followed_most);
    std::vector<double> at;
    for (std::size_t k = 0; k < log.size(); k += stride)
        at.push_back(found.first + static_cast<double>(k) * found.scale);
    const auto last = static_cast<double>(program.size() - 1);
    double window = std::max(8.0, window_share * last);
    const auto point_at = [&](double where) {
        const auto i = std::min(static_cast<std::size_t>(where), program.size() - 2);
        return Vec3(program.points[i] + (where - static_cast<double>(i)) * (program.points[i + 1] - program.points[i]));
    };
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    std::vector<PointPair> pairs;
    for (int round = 0; round < follow_rounds; ++round) {
        pairs.clear();
        for (std::size_t j = 0; j < at.size(); ++j) {
            if (at[j] >= 0 && at[j] <= last) pairs.push_back({log.points[j * stride], point_at(at[j])});
        }
        pose = pose_of_pairs(pairs);
        for (std::size_t j = 0; j < at.size(); ++j) {
            const double expected = at[j];
            const Vec3 p = pose * log.points[j * stride];
            double least = std::numeric_limits<double>::infinity();
            const auto from = static_cast<std::ptrdiff_t>(std::clamp(std::floor(expected - window), 0.0, last));
            const auto to = static_cast<std::ptrdiff_t>(std::clamp(std::ceil(expected + window), 0.0, last));
            for (std::ptrdiff_t i = from; i < to; ++i) {
                const Vec3& a = program.points[static_cast<std::size_t>(i)];
                const Vec3 displacement = program.points[static_cast<std::size_t>(i + 1)] - a;
                const double part =
                    std::clamp((p - a).dot(displacement) / std::max(displacement.squaredNorm(), 1e-12), 0.0, 1.0);
                const double distance = (a + part * displacement - p).squaredNorm();
                if (distance >= least) continue;
                least = distance;
                at[j] = static_cast<double>(i) + part;
            }
        }
        window = std::max(4.0, window / 2);
    }
    return pose;
}

}  // namespace

PathProfile profile_of(const Toolpath& path, std::size_t most_points) {
    double length = 0;
    std::int64_t first = -1;
    for (std::int64_t m = 0; m < path.size(); ++m) {
        const double part = path.length(m);
        if (!std::isfinite(part)) continue;
        if (first < 0) first = m;
        length += part;
    }
    EvenPoints points(length / static_cast<double>(most_points));
    if (first < 0 || !(length > 0)) return points.take();
    for (std::int64_t m = first; m < path.size(); ++m) {
        const double part = path.length(m);
        if (!std::isfinite(part)) continue;
        if (!points.begun()) points.go_to(path.begin(m));
        const bool curved = is_curved(path.motions().kind[static_cast<std::size_t>(m)]);
        const int pieces = curved ? std::clamp(static_cast<int>(part / 0.2), 8, 720) : 1;
        for (int k = 1; k < pieces; ++k) points.go_to(path.at(m, static_cast<double>(k) / pieces));
        points.go_to(path.end(m));
    }
    return points.take();
}

PathProfile profile_of(const Trajectory& path, double spacing) {
    constexpr double most_points = 1 << 21;  // of a path of the program's size, run some 60 times
    EvenPoints points(spacing);
    double length = 0;
    std::vector<double> x(static_cast<std::size_t>(block_points)), y(x.size()), z(x.size());
    for (PointIndex begin = 0; begin < path.count; begin += block_points) {
        const auto n = static_cast<std::size_t>(std::min(block_points, path.count - begin));
        path.read(begin, {x.data(), n}, {y.data(), n}, {z.data(), n});
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 p(x[i], y[i], z[i]);
            if (!p.allFinite() || (points.begun() && (p - points.last()).squaredNorm() < least_step * least_step))
                continue;
            if (points.begun()) length += (p - points.last()).norm();
            if (length > most_points * spacing) return EvenPoints(spacing).take();
            points.go_to(p);
        }
    }
    return points.take();
}

Eigen::Isometry3d pose_of_pairs(const std::vector<PointPair>& pairs) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    std::vector<const PointPair*> kept;
    for (const PointPair& pair : pairs) kept.push_back(&pair);
    for (int round = 0; round < pair_rounds && !kept.empty(); ++round) {
        Vec3 from = Vec3::Zero(), to = Vec3::Zero();
        for (const PointPair* pair : kept) {
            from += pair->log;
            to += pair->program;
        }
        from /= static_cast<double>(kept.size());
        to /= static_cast<double>(kept.size());
        double along = 0, across = 0;
        for (const PointPair* pair : kept) {
            const Vec3 a = pair->log - from, b = pair->program - to;
            along += a.x() * b.x() + a.y() * b.y();
            across += a.x() * b.y() - a.y() * b.x();
        }
        pose.linear() = Eigen::AngleAxisd(std::atan2(across, along), Vec3::UnitZ()).toRotationMatrix();
        pose.translation() = to - pose.linear() * from;
        const auto off = [&](const PointPair* pair) { return (pose * pair->log - pair->program).squaredNorm(); };
        kept.clear();
        for (const PointPair& pair : pairs) kept.push_back(&pair);
        const auto least = static_cast<std::ptrdiff_t>(kept_share * static_cast<double>(kept.size()));
        std::nth_element(kept.begin(), kept.begin() + least, kept.end(),
                         [&](const PointPair* a, const PointPair* b) { return off(a) < off(b); });
        kept.resize(static_cast<std::size_t>(least));
    }
    return pose;
}

std::vector<Eigen::Isometry3d> guess_poses(const PathProfile& program, const PathProfile& log) {
    std::vector<Eigen::Isometry3d> poses;
    if (log.size() < least_points || program.size() < least_points) return poses;
    for (const Match& found : match(program, log)) poses.push_back(follow(program, log, found));
    return poses;
}

}  // namespace clsurf
