#include "viz/picture_libraries.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

// The leak checker of preset asan reads the size of the thread-local data of a loaded library from the memory before them.
// Debian's glibc has no size there: depending on other allocations, the checker reads far outside. With this option it does
// not read it.
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

// Calling exit() while a library's constructors ran ended in an assertion of one of OpenImageIO's libraries.
TEST(PictureLibraries, AreLoadedWhenThePreloadEnds) {
    { const PictureLibrariesPreload preload; }
    EXPECT_TRUE(is_loaded("libclsurf_image.so"));
    EXPECT_TRUE(is_loaded("libclsurf_vtk.so"));
}

}  // namespace
}  // namespace clsurf::viz::picture_libraries_test
