#pragma once
// GlWindow: a VTK window on a GL context of ours, without display.

#include <memory>
#include <string>

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

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
    /// Renders and reads the pixels, the mean of each `factor` × `factor`. Throws SystemError with what
    /// VTK complained about.
    [[nodiscard]] Image render(int factor);

private:
    class Complaints;

    std::unique_ptr<GlContext> context_;
    vtkSmartPointer<vtkOutputWindow> complaints_, complaints_before_;
    vtkLogger::Verbosity verbosity_before_;
    vtkNew<vtkGenericOpenGLRenderWindow> window_;
};

}  // namespace clsurf::viz
