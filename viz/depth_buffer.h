#pragma once
// DepthBuffer: which places of a part the part itself hides from the eye.

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
    /// Draws the triangles of a geometry in cells of two pixels. O(triangles + cells they cover).
    void add(const Geometry& geometry);
    /// What another one hides. Domain: of the same camera.
    void add(const DepthBuffer& other);

    /// Whether a triangle lies between a place [mm] and the eye, nearer to the eye by more than `tolerance` [mm].
    [[nodiscard]] bool hides(const Vec3& place, double tolerance) const;

    /// Whether a triangle lies at a place of the picture [px], to a pixel.
    [[nodiscard]] bool covers(const Vec2& pixel) const;

    /// Nearest distances towards the eye [mm], row by row; −infinity: nothing is there.
    [[nodiscard]] std::span<float> cells() { return nearest_; }
    [[nodiscard]] std::span<const float> cells() const { return nearest_; }

private:
    static constexpr double cell = 2;  ///< [px]

    void draw(const Vec3& a, const Vec3& b, const Vec3& c);
    /// Column and row [cells], and the distance towards the eye [mm].
    [[nodiscard]] Vec3 seen(const Vec3& place) const;
    /// The distance [mm] that the cell at a column and a row has; −infinity: nothing is there, or it is outside.
    [[nodiscard]] float nearest_at(double column, double row) const;

    Camera camera_;
    int columns_ = 0, rows_ = 0;
    std::vector<float> nearest_;  ///< cells()
};

}  // namespace clsurf::viz
