#include "viz/image_compare.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "viz/colour_difference.h"
#include "viz/image_library.h"

namespace clsurf::viz {
namespace {

Lab mean_lab(const Image& image, int x, int y) {
    std::array<double, 3> sum{};
    int count = 0;
    for (int v = std::max(0, y - 1); v <= std::min(image.height - 1, y + 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(image.width - 1, x + 1); ++u) {
            const std::uint8_t* p = image.pixel(u, v);
            for (std::size_t k = 0; k < 3; ++k) sum[k] += p[k];
            ++count;
        }
    }
    for (double& s : sum) s /= 255.0 * count;
    return lab_of(sum);
}

}  // namespace

Comparison compare(const Image& a, const Image& b, const CompareRule& rule) {
    const ImageLibrary::Errors errors = image_library().compare(a.rgb.data(), b.rgb.data(), a.width, a.height);
    Comparison comparison;
    comparison.max_error = errors.max;
    comparison.mean_error = errors.mean;
    comparison.psnr = errors.psnr;
    std::int64_t values_over = 0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const std::uint8_t* p = a.pixel(x, y);
            const std::uint8_t* q = b.pixel(x, y);
            bool over = false;
            for (int k = 0; k < 3; ++k) {
                if (std::abs(p[k] - q[k]) / 255.0 <= rule.threshold + 1e-6) continue;
                over = true;
                ++values_over;
            }
            if (!over) continue;
            ++comparison.pixels_over;
            const Lab la = mean_lab(a, x, y);
            const Lab lb = mean_lab(b, x, y);
            comparison.delta_e = std::max(comparison.delta_e, std::hypot(la[0] - lb[0], la[1] - lb[1], la[2] - lb[2]));
        }
    }
    const double share = static_cast<double>(values_over) / std::max<double>(1.0, static_cast<double>(a.rgb.size()));
    comparison.equal = share <= rule.failing_share && comparison.max_error <= 3 * rule.threshold + 1e-6;
    return comparison;
}

Image difference_picture(const Image& a, const Image& b) {
    Image out;
    out.width = a.width;
    out.height = a.height;
    out.rgb.resize(a.rgb.size());
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const std::uint8_t* p = a.pixel(x, y);
            const std::uint8_t* q = b.pixel(x, y);
            int worst = 0;
            for (int k = 0; k < 3; ++k) worst = std::max(worst, std::abs(p[k] - q[k]));
            std::uint8_t* to = out.rgb.data() + (p - a.rgb.data());
            if (worst == 0) {
                const int grey = 200 + (p[0] + p[1] + p[2]) / 3 / 5;
                std::fill(to, to + 3, static_cast<std::uint8_t>(grey));
            } else {
                to[0] = 255;
                to[1] = static_cast<std::uint8_t>(220 - std::min(220, worst * 4));
                to[2] = 0;
            }
        }
    }
    return out;
}

}  // namespace clsurf::viz
