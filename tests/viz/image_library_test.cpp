#include "viz/image_library.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

// The leak checker of preset asan asks what lies before the thread-local data of a loaded library for their size. Debian's glibc has
// none there: depending on what else was allocated, the checker reads far outside. With this option it does not ask.
extern "C" const char* __asan_default_options() {  // NOLINT: the checker gives the name
    return "intercept_tls_get_addr=0";
}

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
