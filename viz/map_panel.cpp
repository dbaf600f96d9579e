#include "viz/map_panel.h"

namespace clsurf::viz {

bool shows(const Camera& camera, const Look& look, const Vec3& p) {
    return p.allFinite() && camera.shows(p) && (look.box.isEmpty() || look.box.contains(p));
}

}  // namespace clsurf::viz
