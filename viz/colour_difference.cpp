#include "viz/colour_difference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clsurf::viz {
namespace {

double linear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

double degrees(double radians) { return radians * 180 / std::numbers::pi; }
double radians(double degrees_) { return degrees_ * std::numbers::pi / 180; }
double seventh(double v) { return std::pow(v, 7); }

/// Hue angle [deg], 0 … 360; 0 for grey.
double hue(double a, double b) {
    if (a == 0 && b == 0) return 0;
    const double h = degrees(std::atan2(b, a));
    return h < 0 ? h + 360 : h;
}

}  // namespace

Lab lab_of(const std::array<double, 3>& rgb) {
    const double r = linear(rgb[0]);
    const double g = linear(rgb[1]);
    const double b = linear(rgb[2]);
    const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
    const double x = f((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047);
    const double y = f(0.2126729 * r + 0.7151522 * g + 0.0721750 * b);
    const double z = f((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Lab lab_of(const Rgb& rgb) { return lab_of(std::array<double, 3>{rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0}); }

double delta_e00(const Lab& first, const Lab& second) {
    constexpr double far_chroma = 25;
    const double mean_chroma = 0.5 * (std::hypot(first[1], first[2]) + std::hypot(second[1], second[2]));
    const double g = 0.5 * (1 - std::sqrt(seventh(mean_chroma) / (seventh(mean_chroma) + seventh(far_chroma))));
    const double a1 = (1 + g) * first[1];
    const double a2 = (1 + g) * second[1];
    const double c1 = std::hypot(a1, first[2]);
    const double c2 = std::hypot(a2, second[2]);
    const double h1 = hue(a1, first[2]);
    const double h2 = hue(a2, second[2]);
    const bool grey = c1 * c2 == 0;

    double turn = grey ? 0 : h2 - h1;
    if (turn > 180) turn -= 360;
    if (turn < -180) turn += 360;
    const double dl = second[0] - first[0];
    const double dc = c2 - c1;
    const double dh = 2 * std::sqrt(c1 * c2) * std::sin(radians(0.5 * turn));

    const double l = 0.5 * (first[0] + second[0]);
    const double c = 0.5 * (c1 + c2);
    double h = h1 + h2;
    if (!grey) {
        if (std::abs(h1 - h2) > 180) h += h < 360 ? 360 : -360;
        h *= 0.5;
    }
    const double t = 1 - 0.17 * std::cos(radians(h - 30)) + 0.24 * std::cos(radians(2 * h)) +
                     0.32 * std::cos(radians(3 * h + 6)) - 0.20 * std::cos(radians(4 * h - 63));
    const double off = l - 50;
    const double sl = 1 + 0.015 * off * off / std::sqrt(20 + off * off);
    const double sc = 1 + 0.045 * c;
    const double sh = 1 + 0.015 * c * t;
    const double blue = 30 * std::exp(-std::pow((h - 275) / 25, 2));
    const double rotation =
        -std::sin(radians(2 * blue)) * 2 * std::sqrt(seventh(c) / (seventh(c) + seventh(far_chroma)));
    const double x = dl / sl;
    const double y = dc / sc;
    const double z = dh / sh;
    return std::sqrt(x * x + y * y + z * z + rotation * y * z);
}

}  // namespace clsurf::viz
