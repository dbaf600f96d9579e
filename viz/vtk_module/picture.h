#pragma once
// Meshes and flat drawing → pixels, with VTK on the project's own GL context. Only this file draws maps with VTK; scene.cpp
// decides what is drawn where.

#include <string>

#include "viz/canvas.h"
#include "viz/drawing.h"

namespace clsurf::viz::vtk_module {

/// See VtkLibrary (viz/vtk_library.h).
[[nodiscard]] double text_width(const FlatText& text);
[[nodiscard]] Image draw(const Sheet& sheet, const MeshSamples* meshes, const std::string& gl, int supersample,
                         Drawing::Ground* ground);

}  // namespace clsurf::viz::vtk_module
