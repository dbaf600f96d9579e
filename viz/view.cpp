#include "viz/view.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/spelling.h"
#include "core/units.h"

namespace clsurf::viz {
namespace {

constexpr double margin = 1.03;
constexpr std::pair<std::string_view, View> named[] = {
    {"iso", {45, 35.264389682754654}},
    {"top", {0, 90}},
    {"front", {0, 0}},
    {"left", {-90, 0}},
    {"right", {90, 0}},
    {"back", {180, 0}},
    {"bottom", {0, -90}},
};

}  // namespace

View parse_view(const std::string& text) {
    std::vector<std::string_view> names;
    for (const auto& [name, view] : named) {
        if (text == name) return view;
        names.push_back(name);
    }
    View view;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, view.azimuth);
    const bool comma = first.ec == std::errc() && first.ptr != end && *first.ptr == ',';
    const auto second = comma ? std::from_chars(first.ptr + 1, end, view.elevation) : first;
    if (!comma || second.ec != std::errc() || second.ptr != end || !std::isfinite(view.azimuth) ||
        !(std::abs(view.elevation) <= 90)) {
        const std::string nearest = did_you_mean(text, names);
        throw UsageError("--view: '" + text + "' is not a view",
                         nearest.empty() ? "iso, top, front, left, right, back, bottom or AZ,EL in degrees" : nearest);
    }
    return view;
}

Projection Camera::projection() const {
    Projection p;
    p.row(0).head<3>() = right.transpose() / mm_per_pixel;
    p.row(1).head<3>() = up.transpose() / mm_per_pixel;
    p(0, 3) = 0.5 * width - right.dot(centre) / mm_per_pixel;
    p(1, 3) = 0.5 * height - up.dot(centre) / mm_per_pixel;
    return p;
}

ViewAxes axes_of(const View& view) {
    const double az = view.azimuth * rad_per_deg;
    const double el = view.elevation * rad_per_deg;
    const Vec3 towards(std::sin(az) * std::cos(el), -std::cos(az) * std::cos(el), std::sin(el));
    const Vec3 right(std::cos(az), std::sin(az), 0);
    ViewAxes axes;
    axes << right.transpose(), towards.cross(right).transpose(), towards.transpose();
    return axes;
}

Camera camera_for(const ViewAxes& axes, const Box3& extent, int width, int height, const Zoom& zoom) {
    Camera camera;
    camera.width = width;
    camera.height = height;
    camera.right = axes.row(0).transpose();
    camera.up = axes.row(1).transpose();
    camera.towards = axes.row(2).transpose();
    const Vec3 size = extent.isEmpty() ? Vec3(Vec3::Zero()) : Vec3(extent.sizes());
    const Vec3 middle = extent.isEmpty() ? Vec3(Vec3::Zero()) : Vec3(axes.transpose() * extent.center());
    double scale = margin * std::max(size.x() / width, size.y() / height);
    if (!(scale > 0)) scale = 1.0 / std::max(1, std::min(width, height));  // a single point: one millimetre wide
    // The requested part of the picture, in pixels from the middle.
    const double part = std::max(zoom.x1 - zoom.x0, zoom.y1 - zoom.y0);
    const double shift_x = (0.5 * (zoom.x0 + zoom.x1) - 0.5) * width;
    const double shift_y = (0.5 - 0.5 * (zoom.y0 + zoom.y1)) * height;
    camera.centre = middle + scale * (shift_x * camera.right + shift_y * camera.up);
    camera.mm_per_pixel = scale * part;
    camera.depth = 0.5 * size.z();
    return camera;
}

Box3 extent_along(const ViewAxes& axes, const Box3& box) {
    Box3 extent;
    for (int corner = 0; corner < 8 && !box.isEmpty(); ++corner)
        extent.extend(axes * box.corner(static_cast<Box3::CornerType>(corner)));
    return extent;
}

Camera camera_for(const View& view, const Box3& box, int width, int height, const Zoom& zoom) {
    const ViewAxes axes = axes_of(view);
    return camera_for(axes, extent_along(axes, box), width, height, zoom);
}

}  // namespace clsurf::viz
