#pragma once
// The colours that suit a field.

#include "field/field.h"
#include "viz/colour_map.h"

namespace clsurf::viz {

/// Light where values are good, and for signed values at 0; the same for the colour-blind in all cases.
[[nodiscard]] ColourMap usual_colour_map(const FieldInfo& field);

/// The same for lines and dots on white, where the lightest colours could not be seen.
[[nodiscard]] ColourMap colour_map_of_lines(const FieldInfo& field);

/// The name of that map, as make_colour_map() takes it.
[[nodiscard]] std::string usual_colour_map_name(const FieldInfo& field);

/// Colours of a field over a range in shown units, in a map or in its usual one. What the field does not count as beyond, or
/// the eye could not read from a legend, has the colour of the end.
[[nodiscard]] ColourScale scale_of(const FieldInfo& field, double low, double high, int bins = 0);
[[nodiscard]] ColourScale scale_of(const FieldInfo& field, double low, double high, int bins, ColourMap map);

/// How different two values (in inside units) look in the usual colours of a field over its usual range, which it must
/// have: CIEDE2000.
[[nodiscard]] double colour_difference_of(const FieldInfo& field, double a, double b);

}  // namespace clsurf::viz
