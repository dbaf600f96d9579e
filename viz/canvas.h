#pragma once
// Canvas: meshes and flat drawing → pixels. What is drawn where is decided in scene.cpp; vtk_module/picture.cpp draws.
//
// Flat things are placed in pixels of the finished picture, from its lower left corner.

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

/// Everything of a picture. Quads are drawn first, then lines by their levels, then texts.
struct Sheet {
    int width = 0, height = 0;
    Rgb background{255, 255, 255};
    std::vector<MeshPanel> panels;
    std::vector<FlatQuad> quads;
    std::vector<FlatLine> lines;
    std::vector<FlatText> texts;
    bool keep_drawing = false;  ///< the image gets its drawing, too
};

/// Width of a text [px].
[[nodiscard]] double text_width(const FlatText& text);
/// Where a text stands: as wide as it is, and as high as its size [px].
[[nodiscard]] Rect text_rect(const FlatText& text);
/// Interrupts the lines behind a text.
[[nodiscard]] FlatLine halo_of(const FlatText& text, const Rgb& background);
/// Shortens a text in its middle until it is at most so wide [px].
[[nodiscard]] FlatText fitted(FlatText text, double width);

/// Draws at `supersample` times the size and takes the mean, for smooth edges. Throws SystemError.
[[nodiscard]] Image draw(const Sheet& sheet, const std::string& gl, int supersample);
/// The same with meshes that were drawn by a MeshPainter, of a sheet without panels.
[[nodiscard]] Image draw(const Sheet& flat, const MeshSamples& meshes, const std::string& gl, int supersample);

}  // namespace clsurf::viz
