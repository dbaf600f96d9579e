#pragma once
// The CL surface for ParaView and VTK as .vtkhdf (UnstructuredGrid, VTKHDF 1.0), of a whole log or, for a long one, in
// partitions, one for each piece. Cells are polylines, then triangles.

#include <string>
#include <vector>

#include "core/point.h"
#include "viz/export_vtk.h"

namespace clsurf::viz {

/// Writes into the file at `path` (an io::AtomicFile's temporary one). Throws SystemError.
void write_vtkhdf(const std::string& path, const ClSurface& surface, const std::vector<PointData>& data);

/// Writes a piece for merge_vtkhdf(). `own`: the piece's own points in a surface of `points`; others are marked in
/// `vtkGhostType`, as usual in VTK.
void write_vtkhdf(const std::string& path, VtkPiece piece, const PointRange& own, PointIndex points,
                  const std::vector<PointData>& data);

/// One file with a partition for each piece, in the order of their points. Throws InputError: a file is not a piece, is
/// damaged, or has different columns from the first one; UsageError: points of the surface are in no piece or in two;
/// SystemError. O(points), in the memory of a block of points.
void merge_vtkhdf(const std::string& path, const std::vector<std::string>& pieces);

}  // namespace clsurf::viz
