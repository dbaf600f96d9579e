// VTK finds OpenGL through GLEW, which asks glXGetProcAddress of libGL (glvnd). libGL knows nothing of
// a context that OSMesa or EGL made, and answers with functions that do nothing. So the library itself
// defines and exports these two names, and forwards them to whoever made the context. It is linked to
// libOSMesa before anything that brings libGL, so that the plain gl* names are Mesa's as well
// (viz/CMakeLists.txt): the libraries that are loaded with it look there before they look in each
// other. A test draws a pixel and looks at it.

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
    // There is no GLX here. GLEW asks for the current display; the answer must be that there is none,
    // or it goes on to call GLX without one.
    if (std::strncmp(text, "glX", 3) == 0) return reinterpret_cast<void (*)()>(&no_display);
    return resolve(text);
}

__attribute__((visibility("default"))) void (*glXGetProcAddress(const unsigned char* name))() {
    return glXGetProcAddressARB(name);
}

/// What viz/vtk_library.cpp asks for.
__attribute__((visibility("default"))) const void* clsurf_vtk_library() { return &clsurf::viz::vtk_module::table; }
}

bool clsurf::viz::vtk_module::gl_symbols_are_ours() {
    return ::dlsym(RTLD_DEFAULT, "glXGetProcAddressARB") == reinterpret_cast<void*>(&glXGetProcAddressARB);
}
