#include "machined/contact.h"

#include <cmath>
#include <limits>

namespace clsurf {
namespace {

constexpr double level = 1e-9;  ///< sine of a tilt: a normal with a smaller tilt counts as the axis

}  // namespace

double outline_height(const CuttingTool& tool, double rho) {
    if (rho > tool.radius) return std::numeric_limits<double>::infinity();
    const double bottom = tool.radius - tool.corner;
    if (rho <= bottom) return 0;
    const double out = rho - bottom;
    return tool.corner - std::sqrt(std::max(0.0, tool.corner * tool.corner - out * out));
}

double depth_inside(const CuttingTool& tool, const Vec3& off) {
    const double rho = off.head<2>().norm();
    const double below = off.z() - outline_height(tool, rho);
    const double out = rho - (tool.radius - tool.corner);
    if (out <= 0 || !std::isfinite(below)) return below;
    return below * std::sqrt(std::max(0.0, 1 - out * out / (tool.corner * tool.corner)));
}

Vec3 contact_offset(const CuttingTool& tool, const Vec3& normal) { return contact_offset(tool, normal, Vec3::UnitZ()); }

Vec3 contact_offset(const CuttingTool& tool, const Vec3& normal, const Vec3& axis) {
    const Vec3 aside = normal - normal.dot(axis) * axis;
    const double tilt = aside.norm();
    const double bottom = tool.radius - tool.corner;
    Vec3 offset = tool.corner * (axis - normal);
    if (bottom > 0 && tilt > level) offset -= bottom / tilt * aside;
    return offset;
}

}  // namespace clsurf
