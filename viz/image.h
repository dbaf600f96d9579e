#pragma once
// Image: 8-bit RGB pixels, rows from the top. Read and encoded with OpenImageIO.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/column.h"

namespace clsurf::viz {

struct Drawing;

/// A rectangle of pixels, from the picture's upper left corner.
struct PixelBox {
    int x = 0, y = 0, width = 0, height = 0;
};

struct Image {
    int width = 0;
    int height = 0;
    Column<std::uint8_t> rgb;     ///< 3 · width · height
    std::vector<PixelBox> texts;  ///< areas of words and numbers; empty: not known. PNG files store it
    std::shared_ptr<const Drawing> drawing = nullptr;  ///< the same as lines and texts; nullptr: not requested

    [[nodiscard]] const std::uint8_t* pixel(int x, int y) const {
        return rgb.data() +
               3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    }
};

/// Throws InputError: missing, not an image, larger than 2^28 pixels.
[[nodiscard]] Image read_image(const std::string& path);

/// The bytes of a picture file; as "png" the same image always gives the same bytes. viz never writes files, the caller
/// does. `format`: "png", "jpeg", "tiff" or "webp"; PNG and TIFF are lossless. Throws SystemError: the
/// installed OpenImageIO cannot write it.
[[nodiscard]] std::string encode_image(const Image& image, const std::string& description, std::string_view format);

/// The mean of each `factor` × `factor` pixels, from RGB rows that begin at the bottom, as in OpenGL. Domain: both sizes
/// are divisible.
[[nodiscard]] Image shrink_from_below(const std::uint8_t* rgb, int width, int height, int factor);

/// One image above another of the same width.
[[nodiscard]] Image stacked(Image upper, const Image& lower);
/// One image to the left of another of the same height.
[[nodiscard]] Image beside(const Image& left, const Image& right);

}  // namespace clsurf::viz
