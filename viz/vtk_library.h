#pragma once
// VTK, OpenGL and HDF5 behind a table of functions in a shared library of its own (vtk_module), loaded at the first picture or
// VTK file. They bring a hundred libraries, LLVM among them; `check`, `query` and `simulate` start without them.

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

/// Each function is documented where the room declares it (canvas.h, mesh_painter.h, gl_context.h, export_vtk.h, vtkhdf.h).
struct VtkLibrary {
    double (*text_width)(const FlatText& text);
    /// Pixels without their drawing. `meshes`: in place of the sheet's panels; may be nullptr. `ground`: gets what lies below
    /// flat things, in full size; may be nullptr.
    Image (*draw)(const Sheet& sheet, const MeshSamples* meshes, const std::string& gl, int supersample,
                  Drawing::Ground* ground);
    std::unique_ptr<MeshPainter> (*make_mesh_painter)(int width, int height, const std::string& gl, int supersample);
    std::unique_ptr<GlContext> (*make_gl_context)(const std::string& kind, int width, int height);
    /// `marks_ghosts`: points that are not the piece's own ones get `vtkGhostType`.
    void (*write_vtp)(const std::string& path, VtkPiece& piece, const std::vector<PointData>& data, bool marks_ghosts);
    void (*write_vtkhdf)(const std::string& path, VtkPiece& whole, const std::vector<PointData>& data);
    void (*write_vtkhdf_piece)(const std::string& path, VtkPiece& piece, const PointRange& own, PointIndex points,
                               const std::vector<PointData>& data);
    void (*merge_vtkhdf)(const std::string& path, const std::vector<std::string>& pieces);
};

/// The library, loaded at the first call. Throws SystemError. Thread-safe.
[[nodiscard]] const VtkLibrary& vtk_library();

}  // namespace clsurf::viz
