#pragma once
// The functions of this folder as the table VtkLibrary.

#include "viz/vtk_library.h"

namespace clsurf::viz::vtk_module {

extern const VtkLibrary table;

}  // namespace clsurf::viz::vtk_module
