#pragma once
// The context makers for gl_context.cpp, one file each.

#include <memory>
#include <string>

#include "viz/gl_context.h"

namespace clsurf::viz::vtk_module {

/// See VtkLibrary (viz/vtk_library.h).
[[nodiscard]] std::unique_ptr<GlContext> make_gl_context(const std::string& kind, int width, int height);

[[nodiscard]] std::unique_ptr<GlContext> make_osmesa_context(int width, int height);
[[nodiscard]] std::unique_ptr<GlContext> make_egl_context();

using GlFunction = void (*)();
using GlResolver = GlFunction (*)(const char* name);

/// Sets the function that answers glXGetProcAddress (gl_symbols.cpp).
void set_gl_resolver(GlResolver resolver);
/// The answer of the current resolver.
[[nodiscard]] GlFunction resolve_gl(const char* name);
/// Whether libraries find this library's glXGetProcAddress: false if the program has loaded VTK before.
[[nodiscard]] bool gl_symbols_are_ours();

}  // namespace clsurf::viz::vtk_module
