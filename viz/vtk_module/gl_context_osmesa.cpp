#include <GL/osmesa.h>

#include <vector>

#include "core/error.h"
#include "viz/vtk_module/gl_context_makers.h"

namespace clsurf::viz::vtk_module {
namespace {

class OsMesaContext final : public GlContext {
public:
    OsMesaContext(int width, int height) : width_(width), height_(height) {
        // VTK requires 3.2 core; its charts need the stencil.
        const int attributes[] = {OSMESA_FORMAT,
                                  OSMESA_RGBA,
                                  OSMESA_DEPTH_BITS,
                                  24,
                                  OSMESA_STENCIL_BITS,
                                  8,
                                  OSMESA_PROFILE,
                                  OSMESA_CORE_PROFILE,
                                  OSMESA_CONTEXT_MAJOR_VERSION,
                                  3,
                                  OSMESA_CONTEXT_MINOR_VERSION,
                                  2,
                                  0};
        context_ = OSMesaCreateContextAttribs(attributes, nullptr);
        if (context_ == nullptr) throw SystemError("OSMesa cannot make an OpenGL 3.2 context");
        buffer_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
        make_current();
    }
    ~OsMesaContext() override {
        OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
        OSMesaDestroyContext(context_);
    }
    void make_current() override {
        set_gl_resolver([](const char* name) { return reinterpret_cast<GlFunction>(OSMesaGetProcAddress(name)); });
        if (OSMesaMakeCurrent(context_, buffer_.data(), GL_UNSIGNED_BYTE, width_, height_) != GL_TRUE) {
            throw SystemError("OSMesa cannot draw into a buffer of this size");
        }
    }
    [[nodiscard]] std::string renderer() const override { return text(GL_RENDERER); }
    [[nodiscard]] std::string version() const override { return text(GL_VERSION); }

private:
    [[nodiscard]] static std::string text(GLenum what) {
        const GLubyte* answer = glGetString(what);
        return answer == nullptr ? std::string() : reinterpret_cast<const char*>(answer);
    }

    int width_, height_;
    OSMesaContext context_ = nullptr;
    std::vector<unsigned char> buffer_;
};

}  // namespace

std::unique_ptr<GlContext> make_osmesa_context(int width, int height) {
    return std::make_unique<OsMesaContext>(width, height);
}

}  // namespace clsurf::viz::vtk_module
