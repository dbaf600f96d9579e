#pragma once
// The quality map of a part as a PNG file's bytes.

#include <optional>
#include <string>
#include <utility>

#include "python/loaded_part.h"

namespace clsurf::python {

struct PictureRequest {
    std::string field;                               ///< empty: feed_share, or speed where no feed is known
    std::string view = "iso";                        ///< as `clsurf render --view`
    std::optional<std::pair<double, double>> range;  ///< in shown units; nothing: as the field's rule has it
    std::string colour_map;                          ///< empty: by the field
    int width = 1600, height = 1200;                 ///< [px]
};

/// Drawn by EGL without a display. One thread at a time draws. Throws UsageError: an unknown field, view or colour map;
/// SystemError: there is no EGL.
[[nodiscard]] std::string draw_picture(const LoadedPart& loaded, const PictureRequest& request);

}  // namespace clsurf::python
