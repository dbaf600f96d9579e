#pragma once
// GlWindow: a VTK window on the project's own GL context, without a display.

#include <memory>
#include <string>

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include "viz/gl_context.h"
#include "viz/image.h"
#include "viz/mesh_samples.h"

namespace clsurf::viz::vtk_module {

class GlWindow {
public:
    /// Throws SystemError: no context, OpenGL functions missing.
    GlWindow(const std::string& gl, int width, int height);
    ~GlWindow();
    GlWindow(const GlWindow&) = delete;
    GlWindow& operator=(const GlWindow&) = delete;

    [[nodiscard]] vtkRenderWindow* window() { return window_; }
    [[nodiscard]] std::string renderer() const { return context_->renderer(); }
    /// Renders and reads the pixels, the mean of each `factor` × `factor`. Throws SystemError with
    /// VTK's error message.
    [[nodiscard]] Image render(int factor);
    /// Renders and reads the colours of a rectangle, in rows from the bottom. Throws SystemError as render() does.
    [[nodiscard]] Column<std::uint8_t> render(const SampleRect& rect);
    /// The depths of the last rendering.
    [[nodiscard]] Column<float> depths(const SampleRect& rect);
    /// Replaces the rendered pixels of the whole window, in rows from the bottom.
    void put(const Column<std::uint8_t>& rgb);

private:
    class Complaints;

    std::unique_ptr<GlContext> context_;
    vtkSmartPointer<vtkOutputWindow> complaints_, complaints_before_;
    vtkLogger::Verbosity verbosity_before_;
    vtkNew<vtkGenericOpenGLRenderWindow> window_;
};

}  // namespace clsurf::viz::vtk_module
