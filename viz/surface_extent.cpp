#include "viz/surface_extent.h"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "core/block.h"

namespace clsurf::viz {

namespace {

/// Points of a pass, at most one block.
struct Piece {
    PointIndex first, last;
};

std::vector<Piece> pieces_of(const Passes& passes) {
    std::vector<Piece> pieces;
    for (const Pass& pass : passes) {
        if (!is_of_surface(pass.kind)) continue;
        for (PointIndex first = pass.first; first <= pass.last; first += block_points)
            pieces.push_back({first, std::min(pass.last, first + block_points - 1)});
    }
    return pieces;
}

Eigen::AlignedBox3f box_of(const Positions& positions, const Piece& piece, const Eigen::Matrix3f& turned) {
    // A point that is not finite does not change the box.
    Eigen::Array3f low = Eigen::Array3f::Constant(std::numeric_limits<float>::infinity());
    Eigen::Array3f high = -low;
    for (PointIndex i = piece.first; i <= piece.last; ++i) {
        const Eigen::Vector3f q = turned * positions[i];
        if (!q.allFinite()) continue;
        low = low.min(q.array());
        high = high.max(q.array());
    }
    if (!(low <= high).all()) return {};
    return {low.matrix(), high.matrix()};
}

/// Extends a box by some of the pieces. Parallel.
void extend(Eigen::AlignedBox3f& box, const Positions& positions, std::span<const Piece> pieces,
            const Eigen::Matrix3f& turned) {
    std::vector<Eigen::AlignedBox3f> boxes(pieces.size());
    parallel_for(static_cast<std::int64_t>(pieces.size()), 8, [&](std::int64_t first, std::int64_t last) {
        for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(last); ++k)
            boxes[k] = box_of(positions, pieces[k], turned);
    });
    for (const Eigen::AlignedBox3f& b : boxes) box.extend(b);
}

/// A bound of a piece along other axes: that of the boxes of its blocks, plus the rounding error of floats.
Eigen::AlignedBox3f bound_of(const std::vector<Eigen::AlignedBox3f>& boxes, const Piece& piece,
                             const Eigen::Matrix3f& turned) {
    Eigen::AlignedBox3f box;
    for (PointIndex block = piece.first / block_points; block <= piece.last / block_points; ++block)
        box.extend(boxes[static_cast<std::size_t>(block)]);
    if (box.isEmpty()) return box;
    // Along the axes of the workpiece coordinates are only swapped and negated.
    if ((turned.array() != 0).count() == 3)
        return Eigen::AlignedBox3f(Eigen::Vector3f(turned * box.min())).extend(Eigen::Vector3f(turned * box.max()));
    constexpr float rounding = 8 * std::numeric_limits<float>::epsilon();
    const Eigen::Vector3f middle = turned * box.center();
    const Eigen::Vector3f reach = turned.cwiseAbs() * (0.5F * box.sizes());
    const float more = rounding * (box.center().cwiseAbs().sum() + box.sizes().sum());
    return {(middle - reach).array() - more, (middle + reach).array() + more};
}

/// Extends a box by the pieces that may widen it: those with the farthest bounds first, so that few are read.
void extend_by_bounds(Eigen::AlignedBox3f& box, const ClSurface& surface, std::span<const Piece> pieces,
                      const Eigen::Matrix3f& turned) {
    std::vector<Eigen::AlignedBox3f> bounds;
    bounds.reserve(pieces.size());
    for (const Piece& piece : pieces) bounds.push_back(bound_of(surface.surface_boxes, piece, turned));
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        std::size_t lowest = 0, highest = 0;
        for (std::size_t k = 1; k < pieces.size(); ++k) {
            if (bounds[k].min()[axis] < bounds[lowest].min()[axis]) lowest = k;
            if (bounds[k].max()[axis] > bounds[highest].max()[axis]) highest = k;
        }
        for (const std::size_t k : {lowest, highest}) box.extend(box_of(surface.positions, pieces[k], turned));
    }
    constexpr std::size_t at_once = 64;
    std::vector<Piece> wider;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        if (!bounds[k].isEmpty() && !box.contains(bounds[k])) wider.push_back(pieces[k]);
        if (wider.size() < at_once && k + 1 < pieces.size()) continue;
        extend(box, surface.positions, wider, turned);
        wider.clear();
    }
}

}  // namespace

Box3 extent_of(const ClSurface& surface, const ViewAxes& axes) {
    const std::vector<Piece> pieces = pieces_of(surface.passes);
    if (pieces.empty()) return {};
    const Eigen::Matrix3f turned = axes.cast<float>();
    Eigen::AlignedBox3f box;
    if (surface.surface_boxes.empty())
        extend(box, surface.positions, pieces, turned);
    else
        extend_by_bounds(box, surface, pieces, turned);
    if (box.isEmpty()) return {};
    const Vec3 origin = axes * surface.positions.origin;
    return {box.min().cast<double>() + origin, box.max().cast<double>() + origin};
}

}  // namespace clsurf::viz
