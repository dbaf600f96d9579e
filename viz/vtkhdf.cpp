#include "viz/vtkhdf.h"

#include "viz/vtk_library.h"

namespace clsurf::viz {

void write_vtkhdf(const std::string& path, const ClSurface& surface, const std::vector<PointData>& data) {
    VtkPiece whole = whole_of(surface);
    vtk_library().write_vtkhdf(path, whole, data);
}

void write_vtkhdf(const std::string& path, VtkPiece piece, const PointRange& own, PointIndex points,
                  const std::vector<PointData>& data) {
    vtk_library().write_vtkhdf_piece(path, piece, own, points, data);
}

void merge_vtkhdf(const std::string& path, const std::vector<std::string>& pieces) {
    vtk_library().merge_vtkhdf(path, pieces);
}

}  // namespace clsurf::viz
