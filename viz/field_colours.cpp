#include "viz/field_colours.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "viz/colour_difference.h"

namespace clsurf::viz {

std::string usual_colour_map_name(const FieldInfo& field) {
    if (field.scale == FieldScale::diverging) return "coolwarm";
    switch (field.preference) {
        case FieldPreference::higher: return "magma";
        case FieldPreference::lower: return "magma_r";
        case FieldPreference::none: break;
    }
    return "viridis";
}

ColourMap usual_colour_map(const FieldInfo& field) { return make_colour_map(usual_colour_map_name(field)); }

ColourMap colour_map_of_lines(const FieldInfo& field) {
    constexpr double light = 0.15;  // share of the map
    const ColourMap map = usual_colour_map(field);
    if (map.name() == "magma") return map.part(0, 1 - light);
    if (map.name() == "magma_r") return map.part(light, 1);
    return map;
}

ColourScale scale_of(const FieldInfo& field, double low, double high, int bins, ColourMap map) {
    constexpr double readable = 0.005;  // smallest readable difference, as a share of the range
    const double slack = std::max(field.slack * std::abs(field.unit.per_inside), readable * (high - low));
    return {std::move(map), low, high, bins, slack};
}

ColourScale scale_of(const FieldInfo& field, double low, double high, int bins) {
    return scale_of(field, low, high, bins, usual_colour_map(field));
}

double colour_difference_of(const FieldInfo& field, double a, double b) {
    const double factor = field.unit.per_inside;
    const ColourScale scale = scale_of(field, factor * field.usual_range->low, factor * field.usual_range->high);
    return delta_e00(lab_of(scale.colour(factor * a)), lab_of(scale.colour(factor * b)));
}

}  // namespace clsurf::viz
