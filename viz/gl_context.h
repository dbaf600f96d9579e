#pragma once
// GlContext: a current OpenGL context with its own buffer, without a window or a display.
// `osmesa` is Mesa's software renderer (the same pixels everywhere); `egl` is surfaceless EGL, on a GPU
// if there is one.

#include <memory>
#include <string>

namespace clsurf::viz {

class GlContext {
public:
    GlContext() = default;
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;
    virtual ~GlContext() = default;

    virtual void make_current() = 0;
    /// OpenGL's renderer string: "llvmpipe (LLVM 15.0.6, 256 bits)".
    [[nodiscard]] virtual std::string renderer() const = 0;
    /// Version and vendor: "4.5 (Core Profile) Mesa 22.3.6".
    [[nodiscard]] virtual std::string version() const = 0;
};

/// `kind`: "osmesa" or "egl". Throws UsageError (unknown, or not built in), SystemError (no context).
[[nodiscard]] std::unique_ptr<GlContext> make_gl_context(const std::string& kind, int width, int height);

}  // namespace clsurf::viz
