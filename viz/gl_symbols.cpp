// VTK finds OpenGL through GLEW, which asks glXGetProcAddress of libGL (glvnd). libGL knows nothing of
// a context that OSMesa or EGL made, and answers with functions that do nothing. So the program itself
// defines and exports these two names, and forwards them to whoever made the context. It links
// libOSMesa before anything that brings libGL, so that the plain gl* names are Mesa's as well
// (CMakeLists.txt; clsurf_link_gl). A test draws a pixel and looks at it.

#include <dlfcn.h>

#include <cstring>

#include "viz/gl_context_makers.h"

namespace clsurf::viz {
namespace {

GlResolver current_resolver = nullptr;

void* no_display() { return nullptr; }

}  // namespace

void set_gl_resolver(GlResolver resolver) { current_resolver = resolver; }

GlFunction resolve_gl(const char* name) { return current_resolver == nullptr ? nullptr : current_resolver(name); }

}  // namespace clsurf::viz

using clsurf::viz::no_display;

extern "C" {

__attribute__((visibility("default"))) void (*glXGetProcAddressARB(const unsigned char* name))() {
    const clsurf::viz::GlResolver resolve = clsurf::viz::current_resolver;
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
}

bool clsurf::viz::gl_symbols_are_ours() {
    return ::dlsym(RTLD_DEFAULT, "glXGetProcAddressARB") == reinterpret_cast<void*>(&glXGetProcAddressARB);
}
