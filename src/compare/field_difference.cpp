#include "compare/field_difference.h"

#include "core/block.h"
#include "core/not_finite.h"

namespace clsurf {

Field difference_of(const Field& after, const Field& before, const RunAlignment& alignment) {
    Field difference;
    difference.info = after.info;
    difference.info.name += "_change";
    difference.info.label += ", after minus before";
    difference.info.scale = FieldScale::diverging;
    difference.info.preference = FieldPreference::none;
    difference.info.usual_range = {};
    difference.info.note.clear();
    difference.values.resize(after.values.size());
    parallel_for(static_cast<std::int64_t>(after.values.size()), block_points,
                 [&](std::int64_t first, std::int64_t last) {
                     for (std::int64_t i = first; i < last; ++i) {
                         const auto at = static_cast<std::size_t>(i);
                         const PathLocation& place = alignment.locations[at];
                         difference.values[at] =
                             place.exists() ? after.values[at] - interpolate(before.values, place) : missing<float>;
                     }
                 });
    return difference;
}

}  // namespace clsurf
