#include "viz/gl_window.h"

#include <vtkCallbackCommand.h>
#include <vtkUnsignedCharArray.h>

#include "core/error.h"

namespace clsurf::viz {
namespace {

/// GLEW 2 in VTK 9.1 looks for a GLX display, finds none, and says "Unknown error", which is harmless
/// here (nigels-com/glew issue 273). Every other complaint is kept and ends the drawing.
void take_error(vtkObject*, unsigned long, void* errors, void* message) {
    const std::string text = message == nullptr ? std::string() : static_cast<const char*>(message);
    if (text.find("GLEW could not be initialized: Unknown error") != std::string::npos) return;
    static_cast<std::string*>(errors)->append(text);
}

}  // namespace

GlWindow::GlWindow(const std::string& gl, int width, int height) : context_(make_gl_context(gl, width, height)) {
    vtkNew<vtkCallbackCommand> callback;
    callback->SetCallback(take_error);
    callback->SetClientData(&errors_);
    window_->AddObserver(vtkCommand::ErrorEvent, callback);
    window_->SetSize(width, height);
    window_->SetOwnContext(false);
    window_->SetReadyForRendering(true);
    window_->SetIsCurrent(true);
    window_->SetIsDirect(true);
    window_->SetSupportsOpenGL(true);
    window_->SetFrameBlitModeToNoBlit();
    // With multisampling llvmpipe drops lines shorter than a pixel; edges are smoothed by supersampling.
    window_->SetMultiSamples(0);
    window_->InitializeFromCurrentContext();
    if (context_->renderer().empty()) throw SystemError("OpenGL does not answer");
}

GlWindow::~GlWindow() {
    context_->make_current();
    window_->Finalize();
}

Image GlWindow::render() {
    window_->Render();
    if (!errors_.empty()) throw SystemError("VTK cannot draw: " + errors_);
    const int* size = window_->GetSize();
    vtkNew<vtkUnsignedCharArray> pixels;
    window_->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels, 0);
    Image image;
    image.width = size[0];
    image.height = size[1];
    const std::size_t row = 3 * static_cast<std::size_t>(size[0]);
    image.rgb.resize(row * static_cast<std::size_t>(size[1]));
    if (pixels->GetNumberOfValues() != static_cast<vtkIdType>(image.rgb.size())) throw SystemError("VTK gave no picture");
    // OpenGL counts rows from below.
    for (int y = 0; y < image.height; ++y) {
        const unsigned char* from = pixels->GetPointer(0) + static_cast<std::size_t>(image.height - 1 - y) * row;
        std::copy(from, from + row, image.rgb.data() + static_cast<std::size_t>(y) * row);
    }
    return image;
}

}  // namespace clsurf::viz
