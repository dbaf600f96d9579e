#pragma once
// Fields whose values are names: each class has a colour of its own, and nothing lies between two of them.

#include <map>
#include <string>
#include <vector>

#include "field/field.h"
#include "surface/passes.h"
#include "viz/colour_map.h"
#include "viz/detail.h"

namespace clsurf::viz {

/// A class as a picture shows it.
struct ShownClass {
    std::string name;
    float value = 0;  ///< NaN: of all that have no colour of their own
    Rgb rgb{0, 0, 0};
    double share = 0;  ///< of the cutting points, 0 … 1
};

/// How many points have each value.
using ValueCounts = std::map<float, PointIndex>;
/// Those of cut passes. O(points + runs of equal values).
[[nodiscard]] ValueCounts count_values(const Column<float>& values, const Passes& passes);

/// The classes of one or several fields, and which values they are of.
class FieldClasses {
public:
    /// Most that have a colour of their own. The rest are shown together in two greys that alternate from value to value.
    static constexpr std::size_t most_named = 9;

    FieldClasses() = default;
    /// O(classes log classes).
    FieldClasses(const FieldInfo& info, const ValueCounts& counts);
    /// Shares are those of `values` on cut passes. O(points + classes log classes).
    FieldClasses(const FieldInfo& info, const Column<float>& values, const Passes& passes)
        : FieldClasses(info, count_values(values, passes)) {}

    [[nodiscard]] const std::vector<ShownClass>& shown() const { return shown_; }
    /// A value on scale(): the middle of its class's step; NaN: it has none.
    [[nodiscard]] float place_of(float value) const;
    /// The colour of a value; white: it has none.
    [[nodiscard]] Rgb rgb_of(float value) const;
    /// Steps in the colours of the classes, one wide.
    [[nodiscard]] ColourScale scale() const;

private:
    struct Entry {
        float value = 0;
        std::size_t colour = 0;  ///< index into colours_
    };
    std::vector<Entry> entries_;  ///< in rising order of values
    std::vector<Rgb> colours_;
    std::vector<ShownClass> shown_;  ///< in falling order of shares; those that occur
};

/// The values become those of the points in the middle of vertices, as places on a scale of classes; and cells whose
/// corners are of different classes are divided so that each part is of the class of its nearest corner.
void divide_by_class(Detail& detail, const Column<float>& values, const FieldClasses& classes);

}  // namespace clsurf::viz
