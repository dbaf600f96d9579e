#pragma once
// Fields whose values are names: each class has its own colour, without intermediate colours.

#include <map>
#include <string>
#include <vector>

#include "field/field.h"
#include "surface/passes.h"
#include "viz/colour_map.h"
#include "viz/detail.h"

namespace clsurf::viz {

/// A class as shown in a picture.
struct ShownClass {
    std::string name;
    float value = 0;  ///< NaN: all classes without a colour of their own
    Rgb rgb{0, 0, 0};
    double share = 0;  ///< share of the cutting points, 0 … 1
};

/// The number of points with each value.
using ValueCounts = std::map<float, PointIndex>;
/// Counts points of cut passes. O(points + runs of equal values).
[[nodiscard]] ValueCounts count_values(const Column<float>& values, const Passes& passes);

/// The classes of one or several fields, and their values.
class FieldClasses {
public:
    /// The most classes with a colour of their own. The others have two greys that alternate from value to value.
    static constexpr std::size_t most_named = 9;

    FieldClasses() = default;
    /// O(classes log classes).
    FieldClasses(const FieldInfo& info, const ValueCounts& counts);
    /// Shares are of `values` on cut passes. O(points + classes log classes).
    FieldClasses(const FieldInfo& info, const Column<float>& values, const Passes& passes)
        : FieldClasses(info, count_values(values, passes)) {}

    [[nodiscard]] const std::vector<ShownClass>& shown() const { return shown_; }
    /// The position of a value on scale(): the middle of its class's step; NaN: no class.
    [[nodiscard]] float place_of(float value) const;
    /// The colour of a value; white: no class.
    [[nodiscard]] Rgb rgb_of(float value) const;
    /// One step per class, of width one, in the colours of the classes.
    [[nodiscard]] ColourScale scale() const;

private:
    struct Entry {
        float value = 0;
        std::size_t colour = 0;  ///< index into colours_
    };
    std::vector<Entry> entries_;  ///< by increasing value
    std::vector<Rgb> colours_;
    std::vector<ShownClass> shown_;  ///< by decreasing share; only those that occur
};

/// Sets the value of each vertex to that of its middle point, as a position on the scale of classes. Divides cells whose
/// corners are of different classes, so that each part has the class of its nearest corner.
void divide_by_class(Detail& detail, const Column<float>& values, const FieldClasses& classes);

}  // namespace clsurf::viz
