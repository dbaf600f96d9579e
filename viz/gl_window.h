#pragma once
// GlWindow: a VTK window on a GL context of ours, without display (docs/design/rendering.md).

#include <memory>
#include <string>

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>

#include "viz/gl_context.h"
#include "viz/image.h"

namespace clsurf::viz {

class GlWindow {
public:
    /// Throws SystemError: no context, OpenGL functions missing.
    GlWindow(const std::string& gl, int width, int height);
    ~GlWindow();
    GlWindow(const GlWindow&) = delete;
    GlWindow& operator=(const GlWindow&) = delete;

    [[nodiscard]] vtkRenderWindow* window() { return window_; }
    [[nodiscard]] std::string renderer() const { return context_->renderer(); }
    /// Renders and reads the pixels. Throws SystemError with what VTK complained about.
    [[nodiscard]] Image render();

private:
    std::unique_ptr<GlContext> context_;
    vtkNew<vtkGenericOpenGLRenderWindow> window_;
    std::string errors_;
};

}  // namespace clsurf::viz
