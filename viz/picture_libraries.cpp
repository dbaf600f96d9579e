#include "viz/picture_libraries.h"

#include "viz/image_library.h"
#include "viz/vtk_library.h"

namespace clsurf::viz {

PictureLibrariesPreload::PictureLibrariesPreload()
    : image_(std::async(std::launch::async, [] { (void)image_library(); })),
      vtk_(std::async(std::launch::async, [] { (void)vtk_library(); })) {}

}  // namespace clsurf::viz
