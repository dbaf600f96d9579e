#pragma once
// The items around a map: title, legend, scale bar, axes.

#include <limits>
#include <string>
#include <vector>

#include "viz/beyond.h"
#include "viz/colour_map.h"
#include "viz/map_layout.h"

namespace clsurf::viz {

/// Writes words in at most `most_lines` lines, downwards from `line.y`. If they do not fit, the middle of the last line is
/// shortened. Returns the middle of the line after them [px].
double add_wrapped(Sheet& sheet, const std::string& words, FlatText line, double room,
                   std::size_t most_lines = std::numeric_limits<std::size_t>::max());

/// Title, subtitle and notes; in a wide picture in a column. The notes end `beside` [px] before the right edge, for other
/// items.
void add_title(Sheet& sheet, const MapTexts& texts, double beside, const Look& look, const MapLayout& layout, Rgb ink);

/// The colours with their numbers at the left of `room`, in a tall picture along its top. If there are values beyond an
/// end of the scale, a triangle is added to it.
void add_legend(Sheet& sheet, const ColourScale& scale, const FieldInfo& field, const Beyond& beyond, const Rect& room,
                const Look& look, const MapLayout& layout, Rgb ink);

/// Classes with their colours and shares, in decreasing order, in as many columns as fit into `room`. `missing`: there are
/// places without a class.
void add_class_legend(Sheet& sheet, const std::vector<ShownClass>& classes, bool missing, const Rect& room,
                      const Look& look, const MapLayout& layout, Rgb ink);

/// A bar of a round length; the projection is parallel, so it is valid in the whole picture.
void add_scale_bar(Sheet& sheet, const MeshPanel& panel, const MapLayout& layout, Rgb ink);

/// X, Y and Z in the view of the camera.
void add_axes(Sheet& sheet, const MeshPanel& panel, const Look& look, const MapLayout& layout, Rgb ink);

}  // namespace clsurf::viz
