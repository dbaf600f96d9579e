#include "surface/smoothing_segments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/block.h"
#include "core/point_count.h"
#include "toolpath/smoother_fit.h"

namespace clsurf {
namespace {

// As in docs/guide/fields.md.
constexpr double standing_seconds = 0.020;  ///< the derivatives' usual window …
constexpr PointIndex fewest_standing = 3;   ///< … and no fewer records

std::array<double, 3> position(const Trajectory& path, PointIndex i) {
    std::array<double, 3> p{};
    path.read(i, {p.data(), 1}, {&p[1], 1}, {&p[2], 1});
    return p;
}

/// Standstills inside a range, in order. The search reads records half a standstill apart: a standstill of sufficient
/// length contains two of them.
std::vector<PointRange> standstills(const Trajectory& path, PointRange range) {
    const PointIndex least = points_in(standing_seconds, path.period, fewest_standing);
    const PointIndex stride = std::max<PointIndex>(1, (least - 1) / 2);
    std::vector<std::vector<PointRange>> of_block(
        static_cast<std::size_t>((range.size() + block_points - 1) / block_points));
    for_each_block(range.size(), [&](PointIndex first, PointIndex last) {
        std::vector<PointRange>& mine = of_block[static_cast<std::size_t>(first / block_points)];
        for (PointIndex i = range.first + first; i < range.first + last && i + stride <= range.last; i += stride) {
            const std::array<double, 3> here = position(path, i);
            if (here != position(path, i + stride)) continue;
            PointRange still{i, i};
            while (still.first > range.first && position(path, still.first - 1) == here) --still.first;
            while (still.last < range.last && position(path, still.last + 1) == here) ++still.last;
            if (still.size() >= least) mine.push_back(still);
            i = std::max(i, still.last - stride);
        }
    });
    std::vector<PointRange> found;
    for (const std::vector<PointRange>& block : of_block) {
        for (const PointRange& still : block) {
            if (found.empty() || still.first > found.back().last) found.push_back(still);
        }
    }
    // If the motions between are shorter than a window, the tool creeps, one position step at a time.
    std::vector<PointRange> kept;
    for (std::size_t k = 0; k < found.size(); ++k) {
        const bool after_motion = k == 0 || found[k].first - found[k - 1].last >= least;
        const bool before_motion = k + 1 == found.size() || found[k + 1].first - found[k].last >= least;
        if (after_motion && before_motion) kept.push_back(found[k]);
    }
    return kept;
}

}  // namespace

std::vector<PointRange> smoothing_segments(const Log& log, const Passes& passes) {
    std::vector<PointRange> pieces;
    PassKind before = PassKind::rapid;
    for (const Pass& pass : passes) {
        if (!pieces.empty() && pass.kind == PassKind::cut && before == PassKind::cut) {
            pieces.back().last = pass.last;
        } else {
            pieces.push_back({pass.first, pass.last});
        }
        before = pass.kind;
    }
    return cut_at_gaps(log, std::move(pieces));
}

std::vector<PointRange> split_at_standstills(const std::vector<PointRange>& pieces, const Trajectory& path) {
    std::vector<PointRange> split;
    for (PointRange piece : pieces) {
        for (const PointRange& still : standstills(path, piece)) {
            if (still.first > piece.first) {
                split.push_back({piece.first, still.first});
                piece.first = still.first + 1;
            }
            const PointRange rest{piece.first, still.last == piece.last ? still.last : still.last - 1};
            split.push_back(rest);
            piece.first = rest.last + 1;
        }
        if (piece.size() > 0) split.push_back(piece);
    }
    return split;
}

std::shared_ptr<const MotionEstimate> estimate_motion(DerivativeMethod method, const Log& log, const Trajectory& path,
                                                      const Passes& passes) {
    if (method == DerivativeMethod::savgol) return nullptr;
    return std::make_shared<const MotionEstimate>(log, path,
                                                  split_at_standstills(smoothing_segments(log, passes), path));
}

}  // namespace clsurf
