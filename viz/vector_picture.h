#pragma once
// A drawing as a file: SVG, PDF. viz never writes files, the caller does.

#include <string>

#include "viz/drawing.h"

namespace clsurf::viz {

/// A stand-alone document (SVG 1.1): texts are texts, surfaces are embedded PNGs. Throws SystemError.
[[nodiscard]] std::string svg_text(const Drawing& drawing, const std::string& title);

/// One page with 0.75 points per pixel: texts are texts, with embedded fonts. The same drawing gives the same bytes. Throws
/// SystemError.
[[nodiscard]] std::string pdf_bytes(const Drawing& drawing, const std::string& title);

}  // namespace clsurf::viz
