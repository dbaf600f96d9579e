#include "viz/image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "core/error.h"
#include "core/parallel.h"

namespace clsurf::viz {
namespace {

constexpr std::int64_t most_pixels = std::int64_t{1} << 28;

}  // namespace

Image read_image(const std::string& path) {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
    if (!input) throw InputError(Place::of_file(path), "cannot be read as an image: " + OIIO::geterror());
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width <= 0 || spec.height <= 0 || std::int64_t{spec.width} * spec.height > most_pixels) {
        throw InputError(Place::of_file(path), "image of an impossible size");
    }
    Image image;
    image.width = spec.width;
    image.height = spec.height;
    const std::size_t pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    Column<std::uint8_t> raw(pixels * channels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, raw.data())) {
        throw InputError(Place::of_file(path), "cannot be read as an image: " + input->geterror());
    }
    image.rgb.resize(pixels * 3);
    for (std::size_t i = 0; i < pixels; ++i) {
        for (std::size_t k = 0; k < 3; ++k) image.rgb[3 * i + k] = raw[i * channels + (channels >= 3 ? k : 0)];
    }
    return image;
}

std::string encode_png(const Image& image, const std::string& description) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput buffer(bytes);
    OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("ImageDescription", description);
    spec.attribute("Software", "clsurf");
    spec.attribute("png:compressionLevel", 3);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png");
    if (!output || !output->set_ioproxy(&buffer) || !output->open("clsurf.png", spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, image.rgb.data()) || !output->close()) {
        throw SystemError("OpenImageIO cannot write PNG: " + (output ? output->geterror() : OIIO::geterror()));
    }
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
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
