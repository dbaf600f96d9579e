#pragma once
// Meshes and flat drawing → pixels, through VTK on a GL context of our own. The only VTK in the drawing of maps; what is drawn
// where is decided in scene.cpp.

#include <string>

#include "viz/canvas.h"
#include "viz/drawing.h"

namespace clsurf::viz::vtk_module {

/// As VtkLibrary has them (viz/vtk_library.h).
[[nodiscard]] double text_width(const FlatText& text);
[[nodiscard]] Image draw(const Sheet& sheet, const MeshSamples* meshes, const std::string& gl, int supersample,
                         Drawing::Ground* ground);

}  // namespace clsurf::viz::vtk_module
