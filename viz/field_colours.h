#pragma once
// The default colours of fields.

#include "field/field.h"
#include "viz/colour_map.h"

namespace clsurf::viz {

/// Light for good values, and for signed values at 0; safe for colour-blind readers.
[[nodiscard]] ColourMap usual_colour_map(const FieldInfo& field);

/// The same for lines and dots on white, without the lightest colours, which would not be visible.
[[nodiscard]] ColourMap colour_map_of_lines(const FieldInfo& field);

/// The name of that map for make_colour_map().
[[nodiscard]] std::string usual_colour_map_name(const FieldInfo& field);

/// Colours of a field over a range in shown units, in a given map or its default one. A value beyond an end has the colour of
/// the end if it is within the slack of the field, or if the difference cannot be read from a legend.
[[nodiscard]] ColourScale scale_of(const FieldInfo& field, double low, double high, int bins = 0);
[[nodiscard]] ColourScale scale_of(const FieldInfo& field, double low, double high, int bins, ColourMap map);

/// The difference CIEDE2000 of the colours of two values (in internal units), in the default colours of a field over its
/// default range. Domain: the field has one.
[[nodiscard]] double colour_difference_of(const FieldInfo& field, double a, double b);

}  // namespace clsurf::viz
