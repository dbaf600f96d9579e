#include "viz/image.h"

#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "viz/image_library.h"

namespace clsurf::viz {
namespace {

constexpr std::int64_t most_pixels = std::int64_t{1} << 28;

struct Reading {
    Image image;
    std::string error;
};

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
    if (!image_library().read(path.c_str(), &reading, take, report)) {
        throw InputError(Place::of_file(path), "cannot be read as an image: " + reading.error);
    }
    return std::move(reading.image);
}

std::string encode_png(const Image& image, const std::string& description) {
    std::string bytes;
    const auto sink = [](void* context, const void* data, std::size_t size) {
        static_cast<std::string*>(context)->assign(static_cast<const char*>(data), size);
    };
    if (!image_library().encode_png(image.rgb.data(), image.width, image.height, description.c_str(), &bytes, sink)) {
        throw SystemError("the picture cannot be encoded: " + bytes);
    }
    return bytes;
}

Image shrink(const Image& image, int factor) {
    if (factor == 1) return image;
    Image small;
    small.width = image.width / factor;
    small.height = image.height / factor;
    small.rgb.resize(3 * static_cast<std::size_t>(small.width) * static_cast<std::size_t>(small.height));
    const int count = factor * factor;
    parallel_for(small.height, 32, [&](std::int64_t first, std::int64_t last) {
        for (int y = static_cast<int>(first); y < static_cast<int>(last); ++y) {
            std::uint8_t* out = small.rgb.data() + 3 * static_cast<std::size_t>(y) * static_cast<std::size_t>(small.width);
            for (int x = 0; x < small.width; ++x, out += 3) {
                int sum[3] = {count / 2, count / 2, count / 2};
                for (int dy = 0; dy < factor; ++dy) {
                    const std::uint8_t* in = image.pixel(x * factor, y * factor + dy);
                    for (int k = 0; k < 3 * factor; ++k) sum[k % 3] += in[k];
                }
                for (int k = 0; k < 3; ++k) out[k] = static_cast<std::uint8_t>(sum[k] / count);
            }
        }
    });
    return small;
}

}  // namespace clsurf::viz
