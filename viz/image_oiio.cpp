// The shared library behind image_library.h: the only code that uses OpenImageIO.

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <sys/mman.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <vector>

#include "viz/image_library.h"
#include "viz/image_pdf.h"

namespace clsurf::viz {
namespace {

/// A file in memory, for TIFF: OpenImageIO 2.4 cannot read back what it writes to a buffer.
class MemoryFile {
public:
    MemoryFile() : descriptor_(::memfd_create("clsurf", MFD_CLOEXEC)) {}
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }
    [[nodiscard]] std::vector<unsigned char> bytes() const {
        std::vector<unsigned char> bytes(1 << 16);
        std::size_t size = 0;
        for (;;) {
            const ssize_t got =
                ::pread(descriptor_, bytes.data() + size, bytes.size() - size, static_cast<off_t>(size));
            if (got <= 0) break;
            size += static_cast<std::size_t>(got);
            bytes.resize(2 * bytes.size());
        }
        bytes.resize(size);
        return bytes;
    }

private:
    int descriptor_;
};

constexpr const char* texts_attribute = "clsurf:texts";

OIIO::ImageSpec spec_of(int width, int height, const char* description) {
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("ImageDescription", description);
    spec.attribute("Software", "clsurf");
    spec.attribute("png:compressionLevel", 3);
    return spec;
}

/// As little loss as the format allows, for thin lines and text.
void set_compression(const std::string& format, OIIO::ImageSpec& spec) {
    if (format == "jpeg") {
        spec.attribute("Compression", "jpeg:95");
        spec.attribute("jpeg:subsampling", "4:4:4");
    } else if (format == "tiff") {
        spec.attribute("Compression", "zip");
    } else if (format == "webp") {
        spec.attribute("Compression", "webp:100");
    }
}

bool encode(const char* format, const std::uint8_t* rgb, int width, int height, const char* description,
            const char* texts, void* context, void (*sink)(void*, const void*, std::size_t)) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput buffer(bytes);
    OIIO::ImageSpec spec = spec_of(width, height, description);
    set_compression(format, spec);
    if (*texts != '\0' && std::string_view(format) == "png") spec.attribute(texts_attribute, texts);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    const bool in_memory = output && std::string_view(format) != "tiff" && output->supports("ioproxy") != 0;
    const std::unique_ptr<MemoryFile> file = in_memory ? nullptr : std::make_unique<MemoryFile>();
    const std::string path = file ? file->path() : std::string("clsurf.") + format;
    const bool done = output && (!in_memory || output->set_ioproxy(&buffer)) && output->open(path, spec) &&
                      output->write_image(OIIO::TypeDesc::UINT8, rgb) && output->close();
    if (!done) {
        const std::string error = output ? output->geterror() : OIIO::geterror();
        sink(context, error.data(), error.size());
        return false;
    }
    if (file) bytes = file->bytes();
    sink(context, bytes.data(), bytes.size());
    return true;
}

bool read(const char* path, void* context, std::uint8_t* (*take)(void*, int, int), void (*texts)(void*, const char*),
          void (*report)(void*, const char*)) {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
    if (!input) {
        report(context, OIIO::geterror().c_str());
        return false;
    }
    const OIIO::ImageSpec& spec = input->spec();
    const std::string boxes(spec.get_string_attribute(texts_attribute));
    texts(context, boxes.c_str());
    std::uint8_t* const rgb = take(context, spec.width, spec.height);
    if (rgb == nullptr) {
        report(context, "image of an impossible size");
        return false;
    }
    const std::size_t pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
    const int channels = spec.nchannels >= 3 ? 3 : 1;
    std::vector<std::uint8_t> raw(pixels * static_cast<std::size_t>(channels));
    if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, raw.data())) {
        report(context, input->geterror().c_str());
        return false;
    }
    for (std::size_t i = 0; i < pixels; ++i) {
        for (std::size_t k = 0; k < 3; ++k) rgb[3 * i + k] = channels == 3 ? raw[3 * i + k] : raw[i];
    }
    return true;
}

ImageLibrary::Errors compare(const std::uint8_t* a, const std::uint8_t* b, int width, int height) {
    const OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    const OIIO::ImageBuf left(spec, const_cast<std::uint8_t*>(a));
    const OIIO::ImageBuf right(spec, const_cast<std::uint8_t*>(b));
    const OIIO::ImageBufAlgo::CompareResults result = OIIO::ImageBufAlgo::compare(left, right, 1.0F, 1.0F);
    return {result.maxerror, result.meanerror, result.PSNR};
}

constexpr ImageLibrary library{encode, write_pdf, read, compare};

}  // namespace
}  // namespace clsurf::viz

extern "C" __attribute__((visibility("default"))) const void* clsurf_image_library() { return &clsurf::viz::library; }
