#pragma once
// View: directions, zoom and box → a camera with parallel projection, so that lengths can be measured
// in the picture. Numbers only, no OpenGL.

#include <optional>
#include <string>

#include "viz/detail.h"

namespace clsurf::viz {

struct View {
    double azimuth = 45;    ///< [deg] about z: 0 from the front (−Y), 90 from the right (+X)
    double elevation = 35;  ///< [deg] above the XY plane; 90 from above
};

/// "iso", "top", "front", "left", "right", "back", "bottom" or "AZ,EL". Throws UsageError.
[[nodiscard]] View parse_view(const std::string& text);

/// A part of the picture as fractions, from its upper left corner.
struct Zoom {
    double x0 = 0, y0 = 0, x1 = 1, y1 = 1;
};

struct Camera {
    Vec3 centre = Vec3::Zero();  ///< in the middle of the picture [mm]
    double depth = 0;            ///< along `towards`, from `centre` to the nearest or farthest point [mm]
    Vec3 right, up, towards;     ///< unit vectors; `towards` points from the part to the viewer
    double mm_per_pixel = 1;
    int width = 0, height = 0;  ///< [px]

    [[nodiscard]] Projection projection() const;
    /// Whether a position is in the picture.
    [[nodiscard]] bool shows(const Vec3& p) const {
        const Vec2 at = pixel(p);
        return at.x() >= 0 && at.y() >= 0 && at.x() <= width && at.y() <= height;
    }
    /// The pixel of a position, from the picture's lower left corner.
    [[nodiscard]] Vec2 pixel(const Vec3& p) const {
        return Vec2(right.dot(p - centre), up.dot(p - centre)) / mm_per_pixel + 0.5 * Vec2(width, height);
    }
};

/// Rows: right and up in the picture, and towards the viewer. Unit vectors.
using ViewAxes = Eigen::Matrix3d;
[[nodiscard]] ViewAxes axes_of(const View& view);

/// A camera that shows the whole extent along the axes of a view with a small margin, or the `zoom`
/// part of that picture. An empty extent is a point at zero.
[[nodiscard]] Camera camera_for(const ViewAxes& axes, const Box3& extent, int width, int height, const Zoom& zoom);

/// The extent of a box along other axes [mm].
[[nodiscard]] Box3 extent_along(const ViewAxes& axes, const Box3& box);

/// The same for a box in the workpiece.
[[nodiscard]] Camera camera_for(const View& view, const Box3& box, int width, int height, const Zoom& zoom);

}  // namespace clsurf::viz
