#include "viz/picture_libraries.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

// The leak checker of preset asan asks what lies before the thread-local data of a loaded library for their size. Debian's glibc has
// none there: depending on what else was allocated, the checker reads far outside. With this option it does not ask.
extern "C" const char* __asan_default_options() {  // NOLINT: the checker gives the name
    return "intercept_tls_get_addr=0";
}

namespace clsurf::viz::picture_libraries_test {
namespace {

bool is_loaded(const char* name) {
    void* library = ::dlopen(name, RTLD_LAZY | RTLD_NOLOAD);
    if (library != nullptr) ::dlclose(library);
    return library != nullptr;
}

// exit() beside a library's constructors ended in an assertion of one of OpenImageIO's libraries.
TEST(PictureLibraries, AreLoadedWhenThePreloadEnds) {
    { const PictureLibrariesPreload preload; }
    EXPECT_TRUE(is_loaded("libclsurf_image.so"));
    EXPECT_TRUE(is_loaded("libclsurf_vtk.so"));
}

}  // namespace
}  // namespace clsurf::viz::picture_libraries_test
