#include "viz/image_compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "viz/canvas.h"
#include "viz/colour_difference.h"
#include "viz/colour_map.h"
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

/// `worst`: the largest difference of its values, 1 … 255.
Rgb colour_of_difference(int worst) { return {255, static_cast<std::uint8_t>(220 - std::min(220, worst * 4)), 0}; }

/// A strip that explains the colours of a difference picture.
Image difference_legend(int width) {
    const double text = std::clamp(width / 60.0, 9.0, 20.0);
    Sheet sheet;
    sheet.width = width;
    sheet.height = static_cast<int>(2.4 * text);
    const double y = 0.5 * sheet.height;
    const double box = 1.1 * text;
    double x = text;
    const auto name = [&](const Rgb& rgb, const std::string& words) {
        sheet.quads.push_back({{x, y - 0.5 * box, box, box}, rgb});
        FlatText label{x + 1.4 * box, y, words, text, Align::left, false, {20, 20, 24}};
        x += 1.4 * box + text_width(label) + 1.6 * text;
        if (x <= width) sheet.texts.push_back(std::move(label));
    };
    name({230, 230, 230}, "equal");
    for (const int step : {1, 20, 55}) {
        name(colour_of_difference(step),
             step == 55 ? fmt::format("{} or more of 255", step) : fmt::format("{} of 255", step));
    }
    return draw(sheet, "osmesa", 2);
}

/// Puts a picture of the same width below another.
void append_below(Image& image, const Image& strip) {
    append(image.rgb, strip.rgb);
    image.height += strip.height;
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

void blank_texts(Image& a, Image& b) {
    const std::vector<PixelBox>& of_a = a.texts;
    const std::vector<PixelBox>& of_b = b.texts;
    for (const std::vector<PixelBox>* boxes : {&of_a, &of_b}) {
        for (const PixelBox& box : *boxes) {
            const int right = std::min(a.width, box.x + box.width);
            for (int y = std::max(0, box.y); y < std::min(a.height, box.y + box.height); ++y) {
                for (int x = std::max(0, box.x); x < right; ++x) {
                    const std::uint8_t* from = a.pixel(x, y);
                    std::copy(from, from + 3, b.rgb.data() + (from - a.rgb.data()));
                }
            }
        }
    }
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
                const Rgb rgb = colour_of_difference(worst);
                std::copy(rgb.begin(), rgb.end(), to);
            }
        }
    }
    append_below(out, difference_legend(a.width));
    return out;
}

}  // namespace clsurf::viz
