#include "machined/cutter_touch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "machined/contact.h"

namespace clsurf {
namespace {

constexpr double golden = 0.6180339887498949;  ///< (√5 − 1)/2
constexpr int halvings = 40;                   ///< golden^40: 4·10^-9 of a step

struct Least {
    double at = 0, value = 0;
};

/// The least value of a convex function on 0 … 1, by golden-section search. It may be infinite on part of the interval.
template <typename F>
Least least_of(F&& f) {
    const Least first{0, f(0)}, last{1, f(1)};
    double low = 0, high = 1;
    double left = high - golden, right = golden;
    double at_left = f(left), at_right = f(right);
    for (int k = 0; k < halvings; ++k) {
        if (at_left < at_right || (at_left == at_right && first.value <= last.value)) {
            high = std::exchange(right, left);
            at_right = at_left;
            left = high - golden * (high - low);
            at_left = f(left);
        } else {
            low = std::exchange(left, right);
            at_left = at_right;
            right = low + golden * (high - low);
            at_right = f(right);
        }
    }
    const Least inside{0.5 * (low + high), f(0.5 * (low + high))};
    const Least& end = last.value < first.value ? last : first;
    return inside.value < end.value ? inside : end;
}

}  // namespace

/// The centre on the disc of corner centres that is nearest to `off`, both relative to the tip.
Vec3 CutterBody::centre_near(const Vec3& off, const Vec3& axis) const {
    const Vec3 aside = off - off.dot(axis) * axis;
    const double rho = aside.norm(), most = tool_.radius - tool_.corner;
    return tool_.corner * axis + (rho > most ? Vec3(most / rho * aside) : aside);
}

double CutterBody::distance(const Vec3& off, const Vec3& axis) const {
    return (off - centre_near(off, axis)).norm() - tool_.corner;
}

CutterTouch CutterBody::touch(PointIndex point, PointRange piece, const Vec3& place) const {
    CutterTouch best;
    best.distance = std::numeric_limits<double>::infinity();
    const auto look = [&](PointIndex nearest, const Vec3& tip, const Vec3& axis) {
        const Vec3 off = place - tip;
        const Vec3 centre = centre_near(off, axis);
        const double away = (off - centre).norm();
        if (!(away - tool_.corner < best.distance)) return;
        best = {nearest, away - tool_.corner, place};
        if (away > 0) best.projection = tip + centre + tool_.corner / away * (off - centre);
    };
    look(point, path_.at(point), axis_at(point));
    for (PointIndex a = std::max(piece.first, point - 1); a <= std::min(point, piece.last - 1); ++a) {
        const Vec3 from = path_.at(a), step = path_.at(a + 1) - from;
        const Vec3 axis = axis_at(a), turn = axis_at(a + 1) - axis;
        const auto axis_between = [&](double t) { return Vec3((axis + t * turn).normalized()); };
        const double t = least_of([&](double s) { return distance(place - from - s * step, axis_between(s)); }).at;
        look(t < 0.5 ? a : a + 1, from + t * step, axis_between(t));
    }
    return best;
}

double CutterBody::lowest(PointIndex point, PointRange piece, const Vec3& place) const {
    const auto over = [&](const Vec3& tip) {
        return tip.z() + outline_height(tool_, (place.head<2>() - tip.head<2>()).norm());
    };
    double lowest = over(path_.at(point));
    for (PointIndex a = std::max(piece.first, point - 1); a <= std::min(point, piece.last - 1); ++a) {
        const Vec3 from = path_.at(a), step = path_.at(a + 1) - from;
        lowest = std::min(lowest, least_of([&](double t) { return over(from + t * step); }).value);
    }
    return lowest;
}

}  // namespace clsurf
