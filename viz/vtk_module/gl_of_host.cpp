// The OpenGL of a module that another program loads (the Python module), in place of gl_symbols.cpp, gl_context_osmesa.cpp
// and viz/vtk_library.cpp (clsurf_link_vtk_of_host). libclsurf_vtk exports its own glX functions, so that VTK draws with
// OSMesa. A module must not do that: its host may have loaded VTK already, and may draw on a display with it. The module's
// contexts come from EGL. libGL (GLVND) passes each call to the vendor of the current context, so that VTK needs only
// the functions of its host.

#include "core/error.h"
#include "viz/vtk_module/gl_context_makers.h"
#include "viz/vtk_module/table.h"

namespace clsurf::viz::vtk_module {
namespace {

GlResolver resolver_of_module = nullptr;

}  // namespace

void set_gl_resolver(GlResolver resolver) { resolver_of_module = resolver; }

GlFunction resolve_gl(const char* name) { return resolver_of_module == nullptr ? nullptr : resolver_of_module(name); }

bool gl_symbols_are_ours() { return true; }

std::unique_ptr<GlContext> make_osmesa_context(int, int) {
    throw SystemError("a module draws with EGL, not with OSMesa");
}

}  // namespace clsurf::viz::vtk_module

const clsurf::viz::VtkLibrary& clsurf::viz::vtk_library() { return vtk_module::table; }
