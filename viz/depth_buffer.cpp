#include "viz/depth_buffer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clsurf::viz {

DepthBuffer::DepthBuffer(const Camera& camera)
    : camera_(camera),
      columns_(static_cast<int>(std::ceil(camera.width / cell)) + 1),
      rows_(static_cast<int>(std::ceil(camera.height / cell)) + 1),
      nearest_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
               -std::numeric_limits<float>::infinity()) {}

void DepthBuffer::add(const Geometry& geometry) {
    const auto vertex = [&](std::uint32_t v) {
        const float* p = geometry.xyz.data() + 3 * static_cast<std::size_t>(v);
        return seen(geometry.origin + Vec3(p[0], p[1], p[2]));
    };
    for (std::size_t i = 0; i + 3 <= geometry.triangles.size(); i += 3)
        draw(vertex(geometry.triangles[i]), vertex(geometry.triangles[i + 1]), vertex(geometry.triangles[i + 2]));
}

void DepthBuffer::add(const DepthBuffer& other) {
    for (std::size_t k = 0; k < nearest_.size(); ++k) nearest_[k] = std::max(nearest_[k], other.nearest_[k]);
}

Vec3 DepthBuffer::seen(const Vec3& place) const {
    const Vec2 at = camera_.pixel(place) / cell;
    return {at.x(), at.y(), camera_.towards.dot(place - camera_.centre)};
}

void DepthBuffer::draw(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double area = (b - a).head<2>().x() * (c - a).y() - (b - a).y() * (c - a).x();
    if (!(std::abs(area) > 0)) return;
    const auto first = [](double v) { return static_cast<int>(std::max(0.0, std::ceil(v - 0.5))); };
    const auto last = [](double v, int count) {
        return static_cast<int>(std::min(static_cast<double>(count) - 1, std::floor(v - 0.5)));
    };
    const int column0 = first(std::min({a.x(), b.x(), c.x()}));
    const int column1 = last(std::max({a.x(), b.x(), c.x()}), columns_);
    const int row0 = first(std::min({a.y(), b.y(), c.y()}));
    const int row1 = last(std::max({a.y(), b.y(), c.y()}), rows_);
    for (int row = row0; row <= row1; ++row) {
        for (int column = column0; column <= column1; ++column) {
            const double x = column + 0.5 - a.x();
            const double y = row + 0.5 - a.y();
            const double v = (x * (c - a).y() - y * (c - a).x()) / area;
            const double w = (y * (b - a).x() - x * (b - a).y()) / area;
            if (v < 0 || w < 0 || v + w > 1) continue;
            float& nearest = nearest_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                                      static_cast<std::size_t>(column)];
            nearest = std::max(nearest, static_cast<float>(a.z() + v * (b - a).z() + w * (c - a).z()));
        }
    }
}

float DepthBuffer::nearest_at(double column, double row) const {
    if (!(column >= 0 && row >= 0 && column < columns_ && row < rows_)) return -std::numeric_limits<float>::infinity();
    return nearest_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(column)];
}

bool DepthBuffer::covers(const Vec2& pixel) const {
    return std::isfinite(nearest_at(pixel.x() / cell, pixel.y() / cell));
}

bool DepthBuffer::hides(const Vec3& place, double tolerance) const {
    const Vec3 at = seen(place);
    return nearest_at(at.x(), at.y()) > at.z() + tolerance;
}

}  // namespace clsurf::viz
