#include "repair/points/aligned_points.h"

#include <algorithm>
#include <cmath>

#include "core/not_finite.h"
#include "surface/path_location.h"

namespace clsurf {
namespace {

// The limits of the slope are reciprocals of each other.
constexpr double steepest = 2.2, flattest = 0.45;  ///< of a phase along a pass, in phases per spacing
constexpr double jump_tolerance = 0.05;            ///< share of a phase: smaller differences are not a jump
constexpr double fewest_taken = 0.2;  ///< share of a pass's points: less overlap with earlier passes is not used
constexpr int parts = 4;              ///< resolution of a phase; halves and quarters

class PhaseRunner {
public:
    PhaseRunner(const ProgrammedSurface& programmed, double spacing) : surface_(programmed.surface) {
        phases_.spacing = spacing;
        phases_.of_point.assign(programmed.motion.size(), missing<double>);
    }

    void run(const PointRange& pass) {
        const auto n = static_cast<std::size_t>(pass.size());
        arc_length_.assign(n, 0);
        for (std::size_t k = 1; k < n; ++k) {
            const PointIndex i = pass.first + static_cast<PointIndex>(k);
            arc_length_[k] = arc_length_[k - 1] + (surface_.positions[i] - surface_.positions[i - 1]).norm();
        }
        take_from_neighbours(pass);
        const double sign = scale_to_spacing();
        keep_even_phases(sign);
        fill(sign);
        for (std::size_t k = 0; k < n; ++k) phases_.of_point[static_cast<std::size_t>(pass.first) + k] = mine_[k];
    }

    Phases take() { return std::move(phases_); }

private:
    /// Takes the phase at each point from an adjacent pass that has one already.
    void take_from_neighbours(const PointRange& pass) {
        mine_.assign(arc_length_.size(), missing<double>);
        for (std::size_t k = 0; k < mine_.size(); ++k) {
            const PointIndex i = pass.first + static_cast<PointIndex>(k);
            for (const Side side : {Side::left, Side::right}) {
                if (!surface_.neighbours.has(side, i) || surface_.neighbours.neighbour(side, i) >= pass.first) continue;
                const Eigen::Vector3f feed =
                    surface_.positions[std::min(i + 1, pass.last)] - surface_.positions[std::max(i - 1, pass.first)];
                const PathLocation at = adjacent_location(surface_, {i, 0}, feed, side);
                if (!at.exists()) continue;
                const double phase = interpolate(phases_.of_point, at);
                if (phase == phase) mine_[k] = phase;
            }
        }
    }

    /// Doubles or halves the phase until it advances by about one per spacing. Returns the sign of its rate. Without sufficient
    /// overlap, nothing is taken, and the sign is 1.
    double scale_to_spacing() {
        double gone = 0, turned = 0;
        std::size_t taken = 0;
        for (std::size_t k = 1; k < mine_.size(); ++k) {
            if (!(mine_[k] == mine_[k]) || !(mine_[k - 1] == mine_[k - 1])) continue;
            ++taken;
            gone += arc_length_[k] - arc_length_[k - 1];
            turned += mine_[k] - mine_[k - 1];
        }
        const double rate = gone > 0 ? turned / gone * phases_.spacing : 0;
        if (static_cast<double>(taken) < fewest_taken * static_cast<double>(mine_.size()) || std::abs(rate) < 0.1) {
            std::fill(mine_.begin(), mine_.end(), missing<double>);
            return 1;
        }
        const double factor = std::exp2(-std::round(std::log2(std::abs(rate))));
        for (double& phase : mine_) phase *= factor;
        return rate > 0 ? 1 : -1;
    }

    /// Keeps the longest run of phases, and the others only if they continue it. A phase that was taken across the seam between
    /// two passes, or from a wrong pass, jumps.
    void keep_even_phases(double sign) {
        const auto known = [&](std::size_t k) { return mine_[k] == mine_[k]; };
        const auto follows = [&](std::size_t a, std::size_t b) {
            const double run = sign * (mine_[b] - mine_[a]) * phases_.spacing, gone = arc_length_[b] - arc_length_[a],
                         tolerance = jump_tolerance * phases_.spacing;
            return run <= steepest * gone + tolerance && run >= flattest * gone - tolerance;
        };
        std::size_t best = 0, best_size = 0, begin = 0;
        for (std::size_t k = 0; k < mine_.size(); ++k) {
            if (!known(k) || (k > begin && (!known(k - 1) || !follows(k - 1, k)))) begin = known(k) ? k : k + 1;
            if (known(k) && k + 1 - begin > best_size) best = begin, best_size = k + 1 - begin;
        }
        if (best_size == 0) return;
        for (std::size_t k = best + best_size, last = k - 1; k < mine_.size(); ++k) {
            if (!known(k)) continue;
            if (follows(last, k))
                last = k;
            else
                mine_[k] = missing<double>;
        }
        for (std::size_t k = best, last = best; k-- > 0;) {
            if (!known(k)) continue;
            if (follows(k, last))
                last = k;
            else
                mine_[k] = missing<double>;
        }
    }

    /// Interpolates linearly over gaps; beyond the ends one phase per spacing.
    void fill(double sign) {
        std::vector<std::size_t> known;
        for (std::size_t k = 0; k < mine_.size(); ++k) {
            if (mine_[k] == mine_[k]) known.push_back(k);
        }
        if (known.empty()) {
            mine_[0] = 0;
            known.push_back(0);
        }
        const double rate = sign / phases_.spacing;
        for (std::size_t k = 0; k < known.front(); ++k)
            mine_[k] = mine_[known.front()] - rate * (arc_length_[known.front()] - arc_length_[k]);
        for (std::size_t k = known.back() + 1; k < mine_.size(); ++k)
            mine_[k] = mine_[known.back()] + rate * (arc_length_[k] - arc_length_[known.back()]);
        for (std::size_t g = 1; g < known.size(); ++g) {
            const std::size_t a = known[g - 1], b = known[g];
            for (std::size_t k = a + 1; k < b; ++k)
                mine_[k] = mine_[a] + (mine_[b] - mine_[a]) * (arc_length_[k] - arc_length_[a]) /
                                          std::max(arc_length_[b] - arc_length_[a], 1e-12);
        }
    }

    const ClSurface& surface_;
    Phases phases_;
    std::vector<double> arc_length_, mine_;
};

}  // namespace

Phases run_phases(const ProgrammedSurface& programmed, double spacing) {
    PhaseRunner runner(programmed, spacing);
    for (const Pass& pass : programmed.surface.passes) {
        if (pass.kind == PassKind::cut) runner.run({pass.first, pass.last});
    }
    return runner.take();
}

std::vector<AlignedPoint> aligned_points_between(const ProgrammedSurface& programmed, const Phases& phases,
                                                 PointIndex first, PointIndex last, double length) {
    std::vector<AlignedPoint> aligned_points;
    const double margin = nearest_aligned_point * phases.spacing;
    double arc_length = 0;
    for (PointIndex i = first + 1; i <= last; ++i) {
        const double step = (programmed.surface.positions[i] - programmed.surface.positions[i - 1]).norm(),
                     begin = arc_length;
        arc_length += step;
        const double a = parts * phases.of_point[static_cast<std::size_t>(i - 1)],
                     b = parts * phases.of_point[static_cast<std::size_t>(i)];
        if (!(a == a) || !(b == b) || a == b) continue;
        const double part = step / std::abs(b - a);
        const std::int64_t every = parts * part > 2.8 * phases.spacing   ? 1
                                   : parts * part > 1.4 * phases.spacing ? 2
                                                                         : 4;
        const auto low = static_cast<std::int64_t>(std::ceil(std::min(a, b))),
                   high = static_cast<std::int64_t>(std::ceil(std::max(a, b)));
        for (std::int64_t k = low; k < high; ++k) {
            const std::int64_t number = a < b ? k : high - 1 - (k - low);
            if (number % every != 0) continue;
            const double at = begin + step * (static_cast<double>(number) - a) / (b - a);
            const double before = aligned_points.empty() ? 0 : aligned_points.back().arc_length;
            if (at > std::max(margin, before + 0.5 * margin) && at < length - margin)
                aligned_points.push_back({at, number, part});
        }
    }
    return aligned_points;
}

}  // namespace clsurf
