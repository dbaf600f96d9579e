#pragma once
// OpenImageIO behind a table of functions in a separate shared library, loaded when the first
// picture is read or written. Debian's OpenImageIO depends on 250 libraries, which take 0.3 s to
// load: `query` and `moves` do not load them, and `render` loads them in the background.

#include <cstddef>
#include <cstdint>

namespace clsurf::viz {

struct Drawing;

struct ImageLibrary {
    /// Writes the bytes of a picture with `sink(context, bytes, size)`; false: `sink` got the error message. `format`:
    /// "png", "jpeg", "tiff", "webp". PNG stores `texts`.
    bool (*encode)(const char* format, const std::uint8_t* rgb, int width, int height, const char* description,
                   const char* texts, void* context, void (*sink)(void* context, const void* bytes, std::size_t size));
    /// Writes a drawing as one page of PDF, in pieces, with `sink`; false: out of memory.
    bool (*pdf)(const Drawing& drawing, const char* title, void* context,
                void (*sink)(void* context, const void* bytes, std::size_t size));
    /// Allocates with `take(context, width, height)`, which may refuse by returning nullptr, and fills the memory
    /// with RGB; false: `report` got the error message. `texts` gets the texts that encode() stored.
    bool (*read)(const char* path, void* context, std::uint8_t* (*take)(void* context, int width, int height),
                 void (*texts)(void* context, const char* boxes), void (*report)(void* context, const char* text));
    struct Errors {
        double max, mean, psnr;
    };
    /// Largest and mean difference of two pictures, values 0 … 1.
    Errors (*compare)(const std::uint8_t* a, const std::uint8_t* b, int width, int height);
};

/// The library, loaded at the first call. Throws SystemError. Thread-safe.
[[nodiscard]] const ImageLibrary& image_library();

}  // namespace clsurf::viz
