#pragma once
// VTK, OpenGL and HDF5 behind a table of functions in a separate shared library (vtk_module), loaded for the first picture or
// VTK file. They depend on a hundred libraries, including LLVM; `check`, `query` and `simulate` start without them.

#include <memory>
#include <string>
#include <vector>

#include "core/point.h"
#include "viz/drawing.h"

namespace clsurf::viz {

class GlContext;
class MeshPainter;
class MeshSamples;
struct Image;
struct PointData;
struct Sheet;
struct VtkPiece;

/// Each function is documented at its declaration (canvas.h, mesh_painter.h, gl_context.h, export_vtk.h, vtkhdf.h).
struct VtkLibrary {
    double (*text_width)(const FlatText& text);
    /// Pixels without their drawing. `meshes`: used instead of the sheet's panels; may be nullptr. `ground`: gets the image
    /// below the flat items, in full size; may be nullptr.
    Image (*draw)(const Sheet& sheet, const MeshSamples* meshes, const std::string& gl, int supersample,
                  Drawing::Ground* ground);
    std::unique_ptr<MeshPainter> (*make_mesh_painter)(int width, int height, const std::string& gl, int supersample);
    std::unique_ptr<GlContext> (*make_gl_context)(const std::string& kind, int width, int height);
    /// `marks_ghosts`: points that are not the piece's own get `vtkGhostType`.
    void (*write_vtp)(const std::string& path, VtkPiece& piece, const std::vector<PointData>& data, bool marks_ghosts);
    void (*write_vtkhdf)(const std::string& path, VtkPiece& whole, const std::vector<PointData>& data);
    void (*write_vtkhdf_piece)(const std::string& path, VtkPiece& piece, const PointRange& own, PointIndex points,
                               const std::vector<PointData>& data);
    void (*merge_vtkhdf)(const std::string& path, const std::vector<std::string>& pieces);
};

/// The library, loaded at the first call. Throws SystemError. Thread-safe.
[[nodiscard]] const VtkLibrary& vtk_library();

}  // namespace clsurf::viz
