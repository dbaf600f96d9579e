#include "viz/vtk_module/gl_context_makers.h"

#include "core/error.h"

namespace clsurf::viz::vtk_module {

std::unique_ptr<GlContext> make_gl_context(const std::string& kind, int width, int height) {
    if (kind == "osmesa") return make_osmesa_context(width, height);
    if (kind == "egl") {
#ifdef CLSURF_WITH_EGL
        return make_egl_context();
#else
        throw UsageError("--gl egl: this program was built without EGL");
#endif
    }
    throw UsageError("--gl: '" + kind + "' is not osmesa or egl");
}

}  // namespace clsurf::viz::vtk_module
