#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "core/error.h"
#include "viz/vtk_module/gl_context_makers.h"

namespace clsurf::viz::vtk_module {
namespace {

/// Surfaceless: VTK draws into its own framebuffer object.
class EglContext final : public GlContext {
public:
    EglContext()
        : display_before_(eglGetCurrentDisplay()),
          draw_before_(eglGetCurrentSurface(EGL_DRAW)),
          read_before_(eglGetCurrentSurface(EGL_READ)),
          context_before_(eglGetCurrentContext()) {
        const auto get_display =
            reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
        if (get_display != nullptr) display_ = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) != EGL_TRUE) {
            throw SystemError("EGL has no surfaceless display here");
        }
        eglBindAPI(EGL_OPENGL_API);
        const EGLint config_attributes[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint found = 0;
        eglChooseConfig(display_, config_attributes, &config, 1, &found);
        const EGLint attributes[] = {
            EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        context_ = eglCreateContext(display_, found > 0 ? config : nullptr, EGL_NO_CONTEXT, attributes);
        if (context_ == EGL_NO_CONTEXT) throw SystemError("EGL cannot make an OpenGL 3.2 context");
        make_current();
    }
    ~EglContext() override {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
        // The display is not terminated: it is shared by the process, which may draw with it.
        if (context_before_ != EGL_NO_CONTEXT)
            eglMakeCurrent(display_before_, draw_before_, read_before_, context_before_);
    }
    void make_current() override {
        set_gl_resolver([](const char* name) { return reinterpret_cast<GlFunction>(eglGetProcAddress(name)); });
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
            throw SystemError("the EGL context cannot be made current");
        }
    }
    [[nodiscard]] std::string renderer() const override { return text(0x1F01); }  // GL_RENDERER
    [[nodiscard]] std::string version() const override { return text(0x1F02); }   // GL_VERSION

private:
    [[nodiscard]] static std::string text(unsigned what) {
        using GetString = const unsigned char* (*)(unsigned);
        const auto get = reinterpret_cast<GetString>(eglGetProcAddress("glGetString"));
        const unsigned char* answer = get != nullptr ? get(what) : nullptr;
        return answer == nullptr ? std::string() : reinterpret_cast<const char*>(answer);
    }

    /// The display and context of a program that draws with EGL itself.
    EGLDisplay display_before_;
    EGLSurface draw_before_, read_before_;
    EGLContext context_before_;
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<GlContext> make_egl_context() { return std::make_unique<EglContext>(); }

}  // namespace clsurf::viz::vtk_module
