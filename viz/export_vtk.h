#pragma once
// The CL surface with its columns for ParaView and VTK, as .vtp (XML PolyData); as .vtkhdf: vtkhdf.h. Passes are polylines;
// triangles fill the gaps between them.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/column.h"
#include "surface/cl_surface.h"
#include "surface/surface_part.h"

namespace clsurf::viz {

/// A column of point data, written in its own type: line and point numbers need more than the 24 bits of a float.
/// Not copied.
struct PointData {
    std::string name;
    std::variant<const Column<float>*, const Column<double>*, const Column<std::uint32_t>*> values;
};

/// Writes into the file at `path` (an io::AtomicFile's temporary one). Throws SystemError.
void write_vtp(const std::string& path, const ClSurface& surface, const std::vector<PointData>& data);

/// A part of a surface as .vtp: its own points, and adjacent ones that its triangles need. Every pass and every triangle of
/// the surface is in exactly one piece.
struct VtkPiece {
    Column<PointIndex> points;  ///< points of the surface; own points first, in order
    PointIndex own_points = 0;
    Column<double> xyz;                              ///< [mm]
    Column<std::int64_t> line_offsets, line_points;  ///< polylines of the own passes
    Column<std::int64_t> triangles;                  ///< 3 points each
};
/// Every point of every pass, and the bands between adjacent passes over all points. `points` and `own_points`
/// stay empty.
[[nodiscard]] VtkPiece whole_of(const ClSurface& surface);
/// The cells of the part's own points.
[[nodiscard]] VtkPiece piece_of(const SurfacePart& part);
/// Points that are not its own are marked in `vtkGhostType`, as usual in VTK.
void write_vtp(const std::string& path, VtkPiece piece, const std::vector<PointData>& data);

}  // namespace clsurf::viz
