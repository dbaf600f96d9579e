#pragma once
// DepthBuffer: which points of a part the part itself hides from the viewer.

#include <span>
#include <vector>

#include "viz/geometry.h"
#include "viz/view.h"

namespace clsurf::viz {

class DepthBuffer {
public:
    DepthBuffer() = default;
    explicit DepthBuffer(const Camera& camera);
    DepthBuffer(const Geometry& geometry, const Camera& camera) : DepthBuffer(camera) { add(geometry); }
    /// Draws the triangles of a geometry in cells of two pixels. O(triangles + covered cells).
    void add(const Geometry& geometry);
    /// Adds what the other one hides. Domain: the same camera.
    void add(const DepthBuffer& other);

    /// Whether a triangle is between a point [mm] and the viewer, closer to the viewer by more than `tolerance` [mm].
    [[nodiscard]] bool hides(const Vec3& place, double tolerance) const;

    /// Whether a triangle covers a point of the picture [px], to one pixel.
    [[nodiscard]] bool covers(const Vec2& pixel) const;

    /// Nearest distances towards the viewer [mm], row by row; −infinity: empty.
    [[nodiscard]] std::span<float> cells() { return nearest_; }
    [[nodiscard]] std::span<const float> cells() const { return nearest_; }

private:
    static constexpr double cell = 2;  ///< [px]

    void draw(const Vec3& a, const Vec3& b, const Vec3& c);
    /// Column and row [cells], and the distance towards the viewer [mm].
    [[nodiscard]] Vec3 seen(const Vec3& place) const;
    /// The distance [mm] stored in the cell at a column and a row; −infinity: empty, or outside.
    [[nodiscard]] float nearest_at(double column, double row) const;

    Camera camera_;
    int columns_ = 0, rows_ = 0;
    std::vector<float> nearest_;  ///< cells()
};

}  // namespace clsurf::viz
