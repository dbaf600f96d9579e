#include "viz/surface_extent.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/block.h"

namespace clsurf::viz {

Box3 extent_of(const ClSurface& surface, const ViewAxes& axes) {
    return extent_of(surface.positions, surface.passes, axes);
}

Box3 extent_of(const Positions& p, std::span<const Pass> passes, const ViewAxes& axes) {
    const Eigen::Matrix3f turned = axes.cast<float>();
    struct Piece {
        PointIndex first, last;
        Eigen::AlignedBox3f box;
    };
    std::vector<Piece> pieces;
    for (const Pass& pass : passes) {
        if (!is_of_surface(pass.kind)) continue;
        for (PointIndex first = pass.first; first <= pass.last; first += block_points) {
            pieces.push_back({first, std::min(pass.last, first + block_points - 1), {}});
        }
    }
    parallel_for(static_cast<std::int64_t>(pieces.size()), 8, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) {
            Piece& piece = pieces[static_cast<std::size_t>(k)];
            // A point that is not finite neither widens nor empties the box.
            Eigen::Array3f low = Eigen::Array3f::Constant(std::numeric_limits<float>::infinity());
            Eigen::Array3f high = -low;
            for (PointIndex i = piece.first; i <= piece.last; ++i) {
                const Eigen::Vector3f q = turned * p[i];
                if (!q.allFinite()) continue;
                low = low.min(q.array());
                high = high.max(q.array());
            }
            if ((low <= high).all()) piece.box = Eigen::AlignedBox3f(low.matrix(), high.matrix());
        }
    });
    Eigen::AlignedBox3f box;
    for (const Piece& piece : pieces) box.extend(piece.box);
    if (box.isEmpty()) return {};
    const Vec3 origin = axes * p.origin;
    return {box.min().cast<double>() + origin, box.max().cast<double>() + origin};
}

}  // namespace clsurf::viz
