#pragma once
// Drawings as PDF, inside the shared library behind image_library.h.

#include <cstddef>

namespace clsurf::viz {

struct Drawing;

/// See ImageLibrary::pdf.
[[nodiscard]] bool write_pdf(const Drawing& drawing, const char* title, void* context,
                             void (*sink)(void* context, const void* bytes, std::size_t size));

}  // namespace clsurf::viz
