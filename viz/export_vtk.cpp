#include "viz/export_vtk.h"

#include <algorithm>

#include "viz/bands.h"
#include "viz/vtk_library.h"

namespace clsurf::viz {
namespace {

Column<double> points_of(const ClSurface& surface) {
    const PointIndex count = surface.positions.size();
    Column<double> xyz(static_cast<std::size_t>(count) * 3);
    for (PointIndex i = 0; i < count; ++i) {
        const Vec3 p = surface.positions.absolute(i);
        for (int k = 0; k < 3; ++k) xyz[static_cast<std::size_t>(3 * i + k)] = p[k];
    }
    return xyz;
}

}  // namespace

VtkPiece whole_of(const ClSurface& surface) {
    VtkPiece whole;
    whole.xyz = points_of(surface);
    whole.line_offsets.push_back(0);
    for (const Pass& pass : surface.passes) {
        if (pass.kind != PassKind::cut) continue;
        for (PointIndex i = pass.first; i <= pass.last; ++i) whole.line_points.push_back(i);
        whole.line_offsets.push_back(static_cast<std::int64_t>(whole.line_points.size()));
    }
    whole.triangles = triangles_of(surface);
    return whole;
}

VtkPiece piece_of(const SurfacePart& part) {
    VtkPiece piece;
    const auto is_own = [&](PointIndex k) { return k >= part.own.first && k <= part.own.last; };
    Column<std::int64_t> place(part.points.size(), std::int64_t{-1});  // index in the piece of each point of the part
    const auto add = [&](std::int64_t k) {
        std::int64_t& at = place[static_cast<std::size_t>(k)];
        if (at >= 0) return;
        at = static_cast<std::int64_t>(piece.points.size());
        piece.points.push_back(part.points[static_cast<std::size_t>(k)]);
        const Vec3 p = part.surface.positions.absolute(k);
        for (int axis = 0; axis < 3; ++axis) piece.xyz.push_back(p[axis]);
    };
    for (std::int64_t k = 0; k < static_cast<std::int64_t>(part.points.size()); ++k) {
        if (is_own(k)) add(k);
    }
    piece.own_points = static_cast<PointIndex>(piece.points.size());
    piece.line_offsets.push_back(0);
    for (const Pass& pass : part.surface.passes) {
        if (pass.kind != PassKind::cut || !is_own(pass.first)) continue;
        for (PointIndex k = pass.first; k <= pass.last; ++k)
            piece.line_points.push_back(place[static_cast<std::size_t>(k)]);
        piece.line_offsets.push_back(static_cast<std::int64_t>(piece.line_points.size()));
    }
    // A triangle belongs to the piece of its first point.
    const Column<std::int64_t> triangles = triangles_of(part.surface);
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        const std::int64_t first = std::min({triangles[t], triangles[t + 1], triangles[t + 2]});
        if (!is_own(first)) continue;
        for (std::size_t corner = t; corner < t + 3; ++corner) {
            add(triangles[corner]);
            piece.triangles.push_back(place[static_cast<std::size_t>(triangles[corner])]);
        }
    }
    return piece;
}

void write_vtp(const std::string& path, VtkPiece piece, const std::vector<PointData>& data) {
    vtk_library().write_vtp(path, piece, data, true);
}

void write_vtp(const std::string& path, const ClSurface& surface, const std::vector<PointData>& data) {
    VtkPiece whole = whole_of(surface);
    vtk_library().write_vtp(path, whole, data, false);
}

}  // namespace clsurf::viz
