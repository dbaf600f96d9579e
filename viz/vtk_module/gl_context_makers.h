#pragma once
// The makers of gl_context.cpp, one file each.

#include <memory>
#include <string>

#include "viz/gl_context.h"

namespace clsurf::viz::vtk_module {

/// As VtkLibrary has it (viz/vtk_library.h).
[[nodiscard]] std::unique_ptr<GlContext> make_gl_context(const std::string& kind, int width, int height);

[[nodiscard]] std::unique_ptr<GlContext> make_osmesa_context(int width, int height);
[[nodiscard]] std::unique_ptr<GlContext> make_egl_context();

using GlFunction = void (*)();
using GlResolver = GlFunction (*)(const char* name);

/// Who answers glXGetProcAddress from now on (gl_symbols.cpp).
void set_gl_resolver(GlResolver resolver);
/// What the current resolver says.
[[nodiscard]] GlFunction resolve_gl(const char* name);
/// Whether libraries that look for glXGetProcAddress find ours: false where the program has loaded VTK before.
[[nodiscard]] bool gl_symbols_are_ours();

}  // namespace clsurf::viz::vtk_module
