#pragma once
// The makers of gl_context.cpp, one file each.

#include <memory>

namespace clsurf::viz {

class GlContext;

[[nodiscard]] std::unique_ptr<GlContext> make_osmesa_context(int width, int height);
[[nodiscard]] std::unique_ptr<GlContext> make_egl_context();

using GlFunction = void (*)();
using GlResolver = GlFunction (*)(const char* name);

/// Who answers glXGetProcAddress from now on (gl_symbols.cpp).
void set_gl_resolver(GlResolver resolver);
/// What the current resolver says.
[[nodiscard]] GlFunction resolve_gl(const char* name);
/// Whether libraries that look for glXGetProcAddress find ours: false where a program that draws was
/// linked without clsurf_link_gl.
[[nodiscard]] bool gl_symbols_are_ours();

}  // namespace clsurf::viz
