#include "viz/picture_libraries.h"

#include "viz/image_library.h"
#include "viz/vtk_library.h"

namespace clsurf::viz {

PictureLibrariesPreload::PictureLibrariesPreload()
    : image_(std::async(std::launch::async, image_library)), vtk_(std::async(std::launch::async, vtk_library)) {}

}  // namespace clsurf::viz
