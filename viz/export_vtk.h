#pragma once
// The CL surface with its columns for ParaView and VTK, as .vtp (XML PolyData); as .vtkhdf: vtkhdf.h. Passes are polylines, gaps
// between them triangles.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/column.h"
#include "surface/cl_surface.h"
#include "surface/surface_part.h"

namespace clsurf::viz {

/// A column of point data, written in its own type: numbers of lines and points need more than the 24 bits of a float.
/// Not copied.
struct PointData {
    std::string name;
    std::variant<const Column<float>*, const Column<double>*, const Column<std::uint32_t>*> values;
};

/// Writes into the file at `path` (an io::AtomicFile's temporary one). Throws SystemError.
void write_vtp(const std::string& path, const ClSurface& surface, const std::vector<PointData>& data);

/// A part of a surface as .vtp: its own points, and those beside it that its triangles need. All pieces together have
/// every pass and every triangle of the surface once.
struct VtkPiece {
    Column<PointIndex> points;  ///< of the surface; first the own ones, in order
    PointIndex own_points = 0;
    Column<double> xyz;                              ///< [mm]
    Column<std::int64_t> line_offsets, line_points;  ///< polylines of the own passes
    Column<std::int64_t> triangles;                  ///< 3 points each
};
/// Every point of every pass, and the bands between adjacent passes as they are drawn, over all points. `points` and `own_points`
/// stay empty.
[[nodiscard]] VtkPiece whole_of(const ClSurface& surface);
/// What belongs to the part's own points.
[[nodiscard]] VtkPiece piece_of(const SurfacePart& part);
/// Points that are not its own are marked in `vtkGhostType`, as VTK does it.
void write_vtp(const std::string& path, VtkPiece piece, const std::vector<PointData>& data);

}  // namespace clsurf::viz
