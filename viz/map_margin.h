#pragma once
// The items around a map: title, legend, scale bar, axes.

#include <limits>
#include <string>
#include <vector>

#include "viz/beyond.h"
#include "viz/colour_map.h"
#include "viz/map_layout.h"

namespace clsurf::viz {

/// Words in as many lines as they need, at most `most_lines`, from `line.y` down; what has no room is left out of the middle of the
/// last one. Returns the middle of the line after them [px].
double add_wrapped(Sheet& sheet, const std::string& words, FlatText line, double room,
                   std::size_t most_lines = std::numeric_limits<std::size_t>::max());

/// Title, subtitle and notes, in a wide picture in a column. The notes end `beside` [px] before the right edge, where other
/// things are.
void add_title(Sheet& sheet, const MapTexts& texts, double beside, const Look& look, const MapLayout& layout, Rgb ink);

/// The colours with their numbers at the left of `room`, in a tall picture across its top; an end beyond which there are
/// values is pointed.
void add_legend(Sheet& sheet, const ColourScale& scale, const FieldInfo& field, const Beyond& beyond, const Rect& room,
                const Look& look, const MapLayout& layout, Rgb ink);

/// Classes with their colours and shares, the largest first, in as many columns as `room` has. `missing`: there are places
/// without a class.
void add_class_legend(Sheet& sheet, const std::vector<ShownClass>& classes, bool missing, const Rect& room,
                      const Look& look, const MapLayout& layout, Rgb ink);

/// A bar of a round length, true in the whole picture since the projection is parallel.
void add_scale_bar(Sheet& sheet, const MeshPanel& panel, const MapLayout& layout, Rgb ink);

/// X, Y and Z as the camera sees them.
void add_axes(Sheet& sheet, const MeshPanel& panel, const Look& look, const MapLayout& layout, Rgb ink);

}  // namespace clsurf::viz
