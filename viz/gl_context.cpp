#include "viz/gl_context.h"

#include "viz/vtk_library.h"

namespace clsurf::viz {

std::unique_ptr<GlContext> make_gl_context(const std::string& kind, int width, int height) {
    return vtk_library().make_gl_context(kind, width, height);
}

}  // namespace clsurf::viz
