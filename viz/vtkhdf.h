#pragma once
// The CL surface for ParaView and VTK as .vtkhdf (UnstructuredGrid, VTKHDF 1.0): of a whole log, or of a long one in partitions,
// one for each piece. Cells are polylines, then triangles.

#include <string>
#include <vector>

#include "core/point.h"
#include "viz/export_vtk.h"

namespace clsurf::viz {

/// Writes into the file at `path` (an io::AtomicFile's temporary one). Throws SystemError.
void write_vtkhdf(const std::string& path, const ClSurface& surface, const std::vector<PointData>& data);

/// A piece, for merge_vtkhdf(). `own`: points of a surface of `points` that are its own ones; others are marked in
/// `vtkGhostType`, as VTK does it.
void write_vtkhdf(const std::string& path, VtkPiece piece, const PointRange& own, PointIndex points,
                  const std::vector<PointData>& data);

/// One file with a partition for each piece, in the order of their points. Throws InputError: a file that is no piece, is damaged,
/// or has other columns than the first one; UsageError: points of the surface are in no piece or in two; SystemError.
/// O(points), with the memory of a block of them.
void merge_vtkhdf(const std::string& path, const std::vector<std::string>& pieces);

}  // namespace clsurf::viz
