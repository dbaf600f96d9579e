#pragma once
// The surface as VTK files; see VtkLibrary (viz/vtk_library.h).

#include <string>
#include <vector>

#include "core/point.h"
#include "viz/export_vtk.h"

namespace clsurf::viz::vtk_module {

void write_vtp(const std::string& path, VtkPiece& piece, const std::vector<PointData>& data, bool marks_ghosts);
void write_vtkhdf(const std::string& path, VtkPiece& whole, const std::vector<PointData>& data);
void write_vtkhdf_piece(const std::string& path, VtkPiece& piece, const PointRange& own, PointIndex points,
                        const std::vector<PointData>& data);
void merge_vtkhdf(const std::string& path, const std::vector<std::string>& pieces);

}  // namespace clsurf::viz::vtk_module
