#include "viz/image_library.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

namespace clsurf::viz::image_library_test {
namespace {

// exit() beside a library's constructors ended in an assertion of one of OpenImageIO's libraries.
TEST(ImageLibrary, IsLoadedWhenThePreloadEnds) {
    { const ImageLibraryPreload preload; }
    void* library = ::dlopen("libclsurf_image.so", RTLD_LAZY | RTLD_NOLOAD);
    EXPECT_NE(library, nullptr);
    if (library != nullptr) ::dlclose(library);
}

}  // namespace
}  // namespace clsurf::viz::image_library_test
