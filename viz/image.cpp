#include "viz/image.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "core/parallel.h"
#include "viz/drawing.h"
#include "viz/image_library.h"

namespace clsurf::viz {
namespace {

constexpr std::int64_t most_pixels = std::int64_t{1} << 28;

struct Reading {
    Image image;
    std::string error;
};

/// "x,y,width,height;x,y,width,height"
std::string boxes_text(const std::vector<PixelBox>& boxes) {
    std::string text;
    for (const PixelBox& box : boxes)
        text += fmt::format("{}{},{},{},{}", text.empty() ? "" : ";", box.x, box.y, box.width, box.height);
    return text;
}

/// Returns no boxes if the text is not such a list.
std::vector<PixelBox> parse_boxes(std::string_view text) {
    std::vector<PixelBox> boxes;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at < end) {
        std::array<int, 4> n{};
        for (std::size_t k = 0; k < n.size(); ++k) {
            const auto [next, error] = std::from_chars(at, end, n[k]);
            const char wanted = k + 1 < n.size() ? ',' : ';';
            if (error != std::errc() || (next < end && *next != wanted)) return {};
            at = next < end ? next + 1 : next;
        }
        boxes.push_back({n[0], n[1], n[2], n[3]});
    }
    return boxes;
}

}  // namespace

Image read_image(const std::string& path) {
    Reading reading;
    const auto take = [](void* context, int width, int height) -> std::uint8_t* {
        Image& image = static_cast<Reading*>(context)->image;
        if (width <= 0 || height <= 0 || std::int64_t{width} * height > most_pixels) return nullptr;
        image.width = width;
        image.height = height;
        image.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        return image.rgb.data();
    };
    const auto report = [](void* context, const char* text) { static_cast<Reading*>(context)->error = text; };
    const auto texts = [](void* context, const char* boxes) {
        static_cast<Reading*>(context)->image.texts = parse_boxes(boxes);
    };
    if (!image_library().read(path.c_str(), &reading, take, texts, report)) {
        throw InputError(Place::of_file(path), "cannot be read as an image: " + reading.error);
    }
    return std::move(reading.image);
}

std::string encode_image(const Image& image, const std::string& description, std::string_view format) {
    std::string bytes;
    const auto sink = [](void* context, const void* data, std::size_t size) {
        static_cast<std::string*>(context)->assign(static_cast<const char*>(data), size);
    };
    if (!image_library().encode(std::string(format).c_str(), image.rgb.data(), image.width, image.height,
                                description.c_str(), boxes_text(image.texts).c_str(), &bytes, sink)) {
        throw SystemError("the picture cannot be encoded: " + bytes);
    }
    return bytes;
}

namespace {}  // namespace

// Averages the stored values, not linear light: dark text and lines on white stay as heavy as
// without supersampling, while averaging light would thin them.
Image shrink_from_below(const std::uint8_t* rgb, int width, int height, int factor) {
    Image small;
    small.width = width / factor;
    small.height = height / factor;
    const std::size_t row = 3 * static_cast<std::size_t>(width);
    const std::size_t values = 3 * static_cast<std::size_t>(small.width);
    small.rgb.resize(values * static_cast<std::size_t>(small.height));
    const int count = factor * factor;
    const auto step = static_cast<std::size_t>(factor);
    parallel_for(small.height, 32, [&](std::int64_t first, std::int64_t last) {
        std::vector<std::uint16_t> sums(values * step);
        for (int y = static_cast<int>(first); y < static_cast<int>(last); ++y) {
            std::fill(sums.begin(), sums.end(), std::uint16_t{0});
            for (int dy = 0; dy < factor; ++dy) {
                const std::uint8_t* in = rgb + static_cast<std::size_t>(height - 1 - y * factor - dy) * row;
                for (std::size_t k = 0; k < sums.size(); ++k) sums[k] = static_cast<std::uint16_t>(sums[k] + in[k]);
            }
            std::uint8_t* out = small.rgb.data() + static_cast<std::size_t>(y) * values;
            const std::uint16_t* sum = sums.data();
            for (int x = 0; x < small.width; ++x, out += 3, sum += 3 * step) {
                for (std::size_t k = 0; k < 3; ++k) {
                    int total = count / 2;
                    for (std::size_t dx = 0; dx < step; ++dx) total += sum[3 * dx + k];
                    out[k] = static_cast<std::uint8_t>(total / count);
                }
            }
        }
    });
    return small;
}

Image stacked(Image upper, const Image& lower) {
    for (PixelBox box : lower.texts) {
        box.y += upper.height;
        upper.texts.push_back(box);
    }
    const std::size_t above = upper.rgb.size();
    upper.rgb.resize(above + lower.rgb.size());
    std::copy(lower.rgb.begin(), lower.rgb.end(), upper.rgb.begin() + static_cast<std::ptrdiff_t>(above));
    if (upper.drawing && lower.drawing) {
        auto both = std::make_shared<Drawing>();
        both->width = upper.width;
        both->height = upper.height + lower.height;
        both->background = upper.drawing->background;
        add(*both, *upper.drawing, 0, lower.height);
        add(*both, *lower.drawing, 0, 0);
        upper.drawing = std::move(both);
    }
    upper.height += lower.height;
    return upper;
}

Image beside(const Image& left, const Image& right) {
    Image both;
    both.width = left.width + right.width;
    both.height = left.height;
    both.rgb.resize(left.rgb.size() + right.rgb.size());
    auto to = both.rgb.begin();
    for (int y = 0; y < both.height; ++y) {
        for (const Image* each : {&left, &right}) {
            const auto row = static_cast<std::ptrdiff_t>(3) * each->width;
            const auto first = each->rgb.begin() + row * y;
            to = std::copy(first, first + row, to);
        }
    }
    both.texts = left.texts;
    for (PixelBox box : right.texts) {
        box.x += left.width;
        both.texts.push_back(box);
    }
    if (left.drawing && right.drawing) {
        auto drawing = std::make_shared<Drawing>();
        drawing->width = both.width;
        drawing->height = both.height;
        drawing->background = left.drawing->background;
        add(*drawing, *left.drawing, 0, 0);
        add(*drawing, *right.drawing, left.width, 0);
        both.drawing = std::move(drawing);
    }
    return both;
}

}  // namespace clsurf::viz
