// VTK finds OpenGL through GLEW, which asks glXGetProcAddress of libGL (glvnd). libGL knows nothing of
// a context that OSMesa or EGL made, and answers with functions that do nothing. So the program itself
// defines and exports these two names, and forwards them to whoever made the context. It links
// libOSMesa before anything that brings libGL, so that the plain gl* names are Mesa's as well
// (CMakeLists.txt; clsurf_link_gl). A test draws a pixel and looks at it.

#include "viz/gl_context_makers.h"

namespace clsurf::viz {
namespace {

GlResolver resolver = nullptr;

}  // namespace

void set_gl_resolver(GlResolver wanted) { resolver = wanted; }

}  // namespace clsurf::viz

extern "C" {

__attribute__((visibility("default"))) void (*glXGetProcAddressARB(const unsigned char* name))() {
    const clsurf::viz::GlResolver resolve = clsurf::viz::resolver;
    return resolve == nullptr ? nullptr : resolve(reinterpret_cast<const char*>(name));
}

__attribute__((visibility("default"))) void (*glXGetProcAddress(const unsigned char* name))() {
    return glXGetProcAddressARB(name);
}

}
