#include "surface/step_over.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "core/block.h"
#include "core/cell_grid.h"
#include "core/statistics.h"

namespace clsurf {
namespace {

constexpr std::size_t probes_wanted = 384;
/// A point is on another part of the path if the arc length to it is this many times its distance.
constexpr double arc_length_over_distance = 3.0;
constexpr double same_place = 1e-3;   ///< [mm]; nearer points are the same pass cut again
constexpr double finest_cells = 256;  ///< cells along the part's diagonal in the first iteration
// The last cells are 2^6/256, a quarter, of the diagonal.
constexpr int most_coarsenings = 7;
constexpr double enough = 0.5;  ///< share of probes that must have found a neighbour

struct Probe {
    PointIndex point = 0;
    double arc_length = 0;   ///< from the start [mm]
    std::size_t run = 0;     ///< by number
    double nearest = 1e300;  ///< [mm]
};

/// Probes by cell; each is in the 27 cells around its own.
class ProbeCells {
public:
    ProbeCells(const Positions& p, const std::vector<Probe>& probes, float cell) : grid_(cell) {
        for (std::uint32_t i = 0; i < probes.size(); ++i) {
            grid_.for_each_near(p[probes[i].point].cast<double>(),
                                [&](CellGrid::Key key) { cells_[key].push_back(i); });
        }
    }
    [[nodiscard]] const std::vector<std::uint32_t>* near(const Eigen::Vector3f& p) const {
        const auto found = cells_.find(grid_.key(p.cast<double>()));
        return found == cells_.end() ? nullptr : &found->second;
    }

private:
    CellGrid grid_;
    std::unordered_map<CellGrid::Key, std::vector<std::uint32_t>> cells_;
};

double distance_to_segment(const Eigen::Vector3f& p, const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    const Eigen::Vector3f chord = b - a;
    const float squared = chord.squaredNorm();
    const float t = squared > 0 ? std::clamp((p - a).dot(chord) / squared, 0.0F, 1.0F) : 0.0F;
    return (a + t * chord - p).norm();
}

Eigen::AlignedBox3f box_of(const Positions& p, const Passes& runs) {
    Eigen::AlignedBox3f box;
    for (const Pass& run : runs) {
        if (run.kind != PassKind::cut) continue;
        std::vector<Eigen::AlignedBox3f> of_block(
            static_cast<std::size_t>((run.size() + block_points - 1) / block_points));
        for_each_block(run.size(), [&](PointIndex first, PointIndex last) {
            Eigen::AlignedBox3f& mine = of_block[static_cast<std::size_t>(first / block_points)];
            for (PointIndex i = run.first + first; i < run.first + last; ++i) mine.extend(p[i]);
        });
        for (const Eigen::AlignedBox3f& part : of_block) box.extend(part);
    }
    return box;
}

/// A point of the path and its arc length.
struct Sample {
    PointIndex point = 0;
    double arc_length = 0;  ///< [mm]
    std::size_t run = 0;    ///< by number
    bool joined = false;    ///< the previous sample is on the same run
};

/// Points of the cutting runs, one per `spacing` [mm] of arc length or slightly more.
std::vector<Sample> thinned(const Passes& runs, const ArcLength& arc_length, double spacing) {
    std::vector<std::vector<Sample>> of_block;
    for (std::size_t number = 0; number < runs.size(); ++number) {
        const Pass& run = runs[number];
        if (run.kind != PassKind::cut) continue;
        const std::size_t base = of_block.size();
        of_block.resize(base + static_cast<std::size_t>((run.size() + block_points - 1) / block_points));
        for_each_block(run.size(), [&](PointIndex first, PointIndex last) {
            std::vector<Sample>& mine = of_block[base + static_cast<std::size_t>(first / block_points)];
            double at = arc_length.to(run.first + first);
            mine.push_back({run.first + first, at, number, first > 0});
            for (PointIndex i = run.first + first + 1; i < run.first + last; ++i) {
                at += arc_length.step(i - 1);
                if (at - mine.back().arc_length >= spacing) mine.push_back({i, at, number, true});
            }
        });
    }
    std::vector<Sample> samples;
    for (const std::vector<Sample>& block : of_block) { samples.insert(samples.end(), block.begin(), block.end()); }
    return samples;
}

}  // namespace

double estimate_step_over(const Positions& positions, const Passes& runs, const ArcLength& arc_length,
                          const CutGroups& groups) {
    const Eigen::AlignedBox3f box = box_of(positions, runs);
    if (box.isEmpty() || box.diagonal().norm() <= 0) return 0;
    const float diagonal = box.diagonal().norm();
    const std::vector<Sample> path = thinned(runs, arc_length, diagonal / (finest_cells * 8));
    std::vector<Probe> probes;
    const std::size_t stride = std::max<std::size_t>(1, path.size() / probes_wanted);
    for (std::size_t i = stride / 2; i < path.size(); i += stride) {
        probes.push_back({path[i].point, path[i].arc_length, path[i].run});
    }
    float cell = diagonal / static_cast<float>(finest_cells);
    for (int iteration = 0; iteration < most_coarsenings; ++iteration, cell *= 2) {
        const ProbeCells cells(positions, probes, cell);
        for (std::size_t k = 1; k < path.size(); ++k) {
            const Eigen::Vector3f here = positions[path[k].point];
            const std::vector<std::uint32_t>* near = cells.near(here);
            if (near == nullptr) continue;
            // The segment before it is included, so that the distance does not depend on the thinning.
            const Eigen::Vector3f before = path[k].joined ? positions[path[k - 1].point] : here;
            for (const std::uint32_t i : *near) {
                Probe& probe = probes[i];
                const double distance = distance_to_segment(positions[probe.point], before, here);
                const bool other =
                    std::abs(path[k].arc_length - probe.arc_length) > arc_length_over_distance * distance;
                if (!other || distance <= same_place || distance >= probe.nearest) continue;
                if (!groups.apart(probe.run, path[k].run)) probe.nearest = distance;
            }
        }
        std::vector<double> found;
        for (const Probe& probe : probes) {
            if (probe.nearest <= cell) found.push_back(probe.nearest);
        }
        if (static_cast<double>(found.size()) < enough * static_cast<double>(probes.size())) continue;
        return median(found);
    }
    return 0;
}

}  // namespace clsurf
