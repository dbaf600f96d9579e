#include "viz/vtk_module/table.h"

#include "viz/vtk_module/gl_context_makers.h"
#include "viz/vtk_module/mesh_painter.h"
#include "viz/vtk_module/picture.h"
#include "viz/vtk_module/vtk_files.h"

namespace clsurf::viz::vtk_module {

constinit const VtkLibrary table{text_width, draw,         make_mesh_painter,  make_gl_context,
                                 write_vtp,  write_vtkhdf, write_vtkhdf_piece, merge_vtkhdf};

}  // namespace clsurf::viz::vtk_module
