#include "viz/image_library.h"

#include "viz/loaded_library.h"

namespace clsurf::viz {

const ImageLibrary& image_library() {
    static const ImageLibrary& library = loaded_table<ImageLibrary>("libclsurf_image.so", "clsurf_image_library");
    return library;
}

}  // namespace clsurf::viz
