#include "viz/vtk_library.h"

#include "viz/loaded_library.h"

namespace clsurf::viz {

const VtkLibrary& vtk_library() {
    static const VtkLibrary& library = loaded_table<VtkLibrary>("libclsurf_vtk.so", "clsurf_vtk_library");
    return library;
}

}  // namespace clsurf::viz
