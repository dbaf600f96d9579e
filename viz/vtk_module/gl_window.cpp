#include "viz/vtk_module/gl_window.h"

#include <algorithm>

#include <vtkUnsignedCharArray.h>

#include "core/error.h"
#include "viz/vtk_module/gl_context_makers.h"

namespace clsurf::viz::vtk_module {
namespace {

// VTK draws into a framebuffer object of its own size; the buffer of the context is never used.
constexpr int context_size = 16;

/// VTK 9.4 and later take the resolver from the window; in earlier versions GLEW asks the exported glX names.
template <typename Window>
void give_resolver(Window* window) {
    if constexpr (requires { window->SetOpenGLSymbolLoader(nullptr, nullptr); }) {
        window->SetOpenGLSymbolLoader([](void*, const char* name) { return resolve_gl(name); }, nullptr);
    } else {
        (void)window;
        if (!gl_symbols_are_ours()) throw SystemError("VTK was loaded before clsurf: it would call another OpenGL");
    }
}

}  // namespace

/// Collects the error messages of all VTK objects.
class GlWindow::Complaints final : public vtkOutputWindow {
public:
    static Complaints* New() {
        auto* made = new Complaints;
        made->InitializeObjectBase();
        return made;
    }
    vtkTypeMacro(Complaints, vtkOutputWindow)

        void DisplayErrorText(const char* text) override {
        const std::string said = text;
        // GLEW 2 in VTK 9.1 looks for a GLX display, finds none, and reports "Unknown error", which is
        // harmless here (nigels-com/glew issue 273). Every other message ends the drawing.
        if (said.find("GLEW could not be initialized: Unknown error") == std::string::npos) errors_ += said;
    }
    [[nodiscard]] const std::string& errors() const { return errors_; }

private:
    std::string errors_;
};

GlWindow::GlWindow(const std::string& gl, int width, int height)
    : context_(make_gl_context(gl, context_size, context_size)),
      complaints_(vtkSmartPointer<Complaints>::New()),
      complaints_before_(vtkOutputWindow::GetInstance()),
      verbosity_before_(vtkLogger::GetCurrentVerbosityCutoff()) {
    if (context_->renderer().empty()) throw SystemError("OpenGL does not answer");
    give_resolver(window_.GetPointer());
    vtkOutputWindow::SetInstance(complaints_);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // it would print the same message
    window_->SetSize(width, height);
    window_->SetOwnContext(false);
    window_->SetReadyForRendering(true);
    window_->SetIsCurrent(true);
    window_->SetIsDirect(true);
    window_->SetSupportsOpenGL(true);
    window_->SetFrameBlitModeToNoBlit();
    // With multisampling llvmpipe drops lines shorter than a pixel; supersampling smooths the edges.
    window_->SetMultiSamples(0);
    window_->InitializeFromCurrentContext();
}

GlWindow::~GlWindow() {
    context_->make_current();
    window_->Finalize();
    vtkOutputWindow::SetInstance(complaints_before_);
    vtkLogger::SetStderrVerbosity(verbosity_before_);
}

Column<std::uint8_t> GlWindow::render(const SampleRect& rect) {
    window_->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    window_->GetPixelData(rect.x, rect.y, rect.x + rect.width - 1, rect.y + rect.height - 1, 0, pixels, 0);
    const std::string& errors = static_cast<const Complaints*>(complaints_.Get())->errors();
    if (!errors.empty()) throw SystemError("VTK cannot draw: " + errors);
    if (static_cast<std::size_t>(pixels->GetNumberOfValues()) != 3 * rect.count())
        throw SystemError("VTK returned no picture");
    Column<std::uint8_t> rgb(3 * rect.count());
    std::copy_n(pixels->GetPointer(0), rgb.size(), rgb.data());
    return rgb;
}

Image GlWindow::render(int factor) {
    const int* size = window_->GetSize();
    const int width = size[0];
    const int height = size[1];
    const Column<std::uint8_t> pixels = render(SampleRect{0, 0, width, height});
    return shrink_from_below(pixels.data(), width, height, factor);
}

Column<float> GlWindow::depths(const SampleRect& rect) {
    Column<float> depths(rect.count());
    if (window_->GetZbufferData(rect.x, rect.y, rect.x + rect.width - 1, rect.y + rect.height - 1, depths.data()) ==
        VTK_ERROR)
        throw SystemError("VTK returned no depths");
    return depths;
}

void GlWindow::put(const Column<std::uint8_t>& rgb) {
    window_->Render();  // creates the buffers
    const int* size = window_->GetSize();
    vtkNew<vtkUnsignedCharArray> pixels;
    pixels->SetNumberOfComponents(3);
    pixels->SetArray(const_cast<std::uint8_t*>(rgb.data()), static_cast<vtkIdType>(rgb.size()), 1);
    if (window()->SetPixelData(0, 0, size[0] - 1, size[1] - 1, pixels, 0, 0) == VTK_ERROR)
        throw SystemError("VTK takes no pixels");
}

}  // namespace clsurf::viz::vtk_module
