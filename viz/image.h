#pragma once
// Image: 8-bit RGB pixels, rows from the top. Read and written through OpenImageIO.

#include <cstdint>
#include <string>

#include "core/column.h"

namespace clsurf::viz {

struct Image {
    int width = 0;
    int height = 0;
    Column<std::uint8_t> rgb;  ///< 3 · width · height
};

/// Throws InputError.
[[nodiscard]] Image read_image(const std::string& path);

/// PNG bytes with sRGB chunk and `description` (how the picture was made) as text; the same image
/// always gives the same bytes. viz never writes files; the caller does (io::AtomicFile).
[[nodiscard]] std::string encode_png(const Image& image, const std::string& description);

}  // namespace clsurf::viz
