#pragma once
// Canvas: meshes and flat drawing → pixels. scene.cpp decides what is drawn where; vtk_module/picture.cpp draws.
//
// Flat items are placed in pixels of the finished picture, from its lower left corner.

#include <string>
#include <string_view>
#include <vector>

#include "viz/colour_map.h"
#include "viz/flat.h"
#include "viz/geometry.h"
#include "viz/gl_context.h"
#include "viz/image.h"
#include "viz/mesh_panel.h"
#include "viz/mesh_samples.h"
#include "viz/view.h"

namespace clsurf::viz {

/// The content of a picture. Quads are drawn first, then lines by level, then texts.
struct Sheet {
    int width = 0, height = 0;
    Rgb background{255, 255, 255};
    std::vector<MeshPanel> panels;
    std::vector<FlatQuad> quads;
    std::vector<FlatLine> lines;
    std::vector<FlatText> texts;
    bool keep_drawing = false;  ///< the image also gets its drawing
};

/// Width of a text [px].
[[nodiscard]] double text_width(const FlatText& text);
/// The rectangle of a text [px]; its height is the text size.
[[nodiscard]] Rect text_rect(const FlatText& text);
/// Interrupts the lines behind a text.
[[nodiscard]] FlatLine halo_of(const FlatText& text, const Rgb& background);
/// Shortens a text in its middle to at most a width [px].
[[nodiscard]] FlatText fitted(FlatText text, double width);

/// Draws at `supersample` times the size and averages, for smooth edges. Throws SystemError.
[[nodiscard]] Image draw(const Sheet& sheet, const std::string& gl, int supersample);
/// The same for a sheet without panels, with meshes that a MeshPainter has drawn.
[[nodiscard]] Image draw(const Sheet& flat, const MeshSamples& meshes, const std::string& gl, int supersample);

}  // namespace clsurf::viz
