#pragma once
// A MeshPainter that draws with VTK.

#include "viz/mesh_painter.h"

namespace clsurf::viz::vtk_module {

[[nodiscard]] std::unique_ptr<MeshPainter> make_mesh_painter(int width, int height, const std::string& gl,
                                                             int supersample);

}  // namespace clsurf::viz::vtk_module
