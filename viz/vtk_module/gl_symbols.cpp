// VTK finds OpenGL through GLEW, which asks glXGetProcAddress of libGL (glvnd). libGL does not know
// a context that OSMesa or EGL made, and returns functions that do nothing. This library therefore
// defines and exports the two glX names, and forwards them to the maker of the context. It is linked to
// libOSMesa before any library that depends on libGL, so that the plain gl* names are Mesa's as well
// (viz/CMakeLists.txt): the libraries that are loaded with it search it before they search each
// other. A test draws a pixel and checks it.

#include <dlfcn.h>

#include <cstring>

#include "viz/vtk_module/gl_context_makers.h"
#include "viz/vtk_module/table.h"

namespace clsurf::viz::vtk_module {
namespace {

GlResolver current_resolver = nullptr;

void* no_display() { return nullptr; }

}  // namespace

void set_gl_resolver(GlResolver resolver) { current_resolver = resolver; }

GlFunction resolve_gl(const char* name) { return current_resolver == nullptr ? nullptr : current_resolver(name); }

}  // namespace clsurf::viz::vtk_module

using clsurf::viz::vtk_module::no_display;

extern "C" {

__attribute__((visibility("default"))) void (*glXGetProcAddressARB(const unsigned char* name))() {
    const clsurf::viz::vtk_module::GlResolver resolve = clsurf::viz::vtk_module::current_resolver;
    const char* const text = reinterpret_cast<const char*>(name);
    if (resolve == nullptr) return nullptr;
    // There is no GLX here. GLEW asks for the current display; the answer must be none,
    // otherwise it calls GLX functions without a display.
    if (std::strncmp(text, "glX", 3) == 0) return reinterpret_cast<void (*)()>(&no_display);
    return resolve(text);
}

__attribute__((visibility("default"))) void (*glXGetProcAddress(const unsigned char* name))() {
    return glXGetProcAddressARB(name);
}

/// The entry that viz/vtk_library.cpp loads.
__attribute__((visibility("default"))) const void* clsurf_vtk_library() { return &clsurf::viz::vtk_module::table; }
}

bool clsurf::viz::vtk_module::gl_symbols_are_ours() {
    return ::dlsym(RTLD_DEFAULT, "glXGetProcAddressARB") == reinterpret_cast<void*>(&glXGetProcAddressARB);
}
