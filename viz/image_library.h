#pragma once
// OpenImageIO behind a table of functions in a shared library of its own, loaded when the first
// picture is read or written. OpenImageIO as Debian builds it brings 250 libraries, and 0.3 s to load
// them, which neither `query` nor `moves` should pay and `render` need not wait for.

#include <cstddef>
#include <cstdint>

namespace clsurf::viz {

struct Drawing;

struct ImageLibrary {
    /// Bytes of a new picture into `sink(context, bytes, size)`; false: `sink` got the error's text. `format`:
    /// "png", "jpeg", "tiff", "webp". `texts` is kept by PNG.
    bool (*encode)(const char* format, const std::uint8_t* rgb, int width, int height, const char* description,
                   const char* texts, void* context, void (*sink)(void* context, const void* bytes, std::size_t size));
    /// A drawing as one page of PDF, in pieces into `sink`; false: there is no memory for it.
    bool (*pdf)(const Drawing& drawing, const char* title, void* context,
                void (*sink)(void* context, const void* bytes, std::size_t size));
    /// Asks for room with `take(context, width, height)`, which may refuse with nullptr, and fills it
    /// with RGB; false: `report` got the error's text. `texts` gets what encode() was given.
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
