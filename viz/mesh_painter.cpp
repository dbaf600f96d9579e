#include "viz/mesh_painter.h"

#include "viz/vtk_library.h"

namespace clsurf::viz {

std::unique_ptr<MeshPainter> make_mesh_painter(int width, int height, const std::string& gl, int supersample) {
    return vtk_library().make_mesh_painter(width, height, gl, supersample);
}

}  // namespace clsurf::viz
