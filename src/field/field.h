#pragma once
// Field: one number per point that can be coloured, plotted and exported, with what it means.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/column.h"
#include "core/units.h"

namespace clsurf {

enum class FieldScale : std::uint8_t {
    sequential,  ///< from low to high
    diverging,   ///< signed, 0 in the middle of the colour map
};

/// Which values are the good ones of a sequential field: a picture shows them light.
enum class FieldPreference : std::uint8_t { none, lower, higher };

/// A range of values, in inside units.
struct ValueRange {
    double low = 0, high = 0;
};

/// What one value of a field means whose values are names: a limit, a cause, a kind of motion.
struct FieldClass {
    float value = 0;
    std::string name;
    bool good = false;  ///< all is well: pictures show it in a light grey
};

/// A unit that owns its name: that of a channel is known only when its log is read.
struct FieldUnit {
    std::string name;       ///< "mm/min"; empty: none
    double per_inside = 1;  ///< shown = inside · per_inside

    FieldUnit() = default;
    // NOLINTNEXTLINE(google-explicit-constructor): rows of fields name a Unit.
    FieldUnit(const Unit& unit) : name(unit.name), per_inside(unit.per_inside) {}
    /// Values that are shown as they are stored.
    explicit FieldUnit(std::string as_stored) : name(std::move(as_stored)) {}
};

struct FieldInfo {
    std::string name;   ///< "speed", the word of --color
    std::string label;  ///< "Path speed"
    FieldUnit unit;     ///< as shown; values are stored in inside units
    FieldScale scale = FieldScale::sequential;
    std::string note;                    ///< how it was computed, "21-point window (20 ms)"; may be empty
    char axis = 0;                       ///< 'x' … 'c' of a component; 0: of all axes together
    std::vector<std::string> also = {};  ///< other words for it: "velocity"
    int report_rank = 0;       ///< its place among the fields that a report has by default, from 1; 0: not there
    bool percentiles = false;  ///< reports give the percentiles of its absolute value
    FieldPreference preference = FieldPreference::none;
    std::vector<FieldClass> classes = {};  ///< of names; empty: values are numbers
    std::string class_word = {};           ///< values are numbers of things, which nothing lies between: "line"
    /// What its colours always span, so that pictures of different runs compare; else the data decide (range.h).
    std::optional<ValueRange> usual_range = {};
    double slack = 0;                 ///< beyond usual_range that still counts as its end, inside units
    double least_span = 0;            ///< of colours, inside units: smaller differences do not matter
    double least_span_of_median = 0;  ///< likewise, as a share of the median
    /// Of a difference that counts as a discontinuity where some points in a row exceed it, inside units; 0: none.
    double threshold = 0;
};

/// Whether values are names or numbers of things: between two of them is nothing.
[[nodiscard]] inline bool has_classes(const FieldInfo& info) {
    return !info.classes.empty() || !info.class_word.empty();
}

struct Field {
    FieldInfo info;
    Column<float> values;  ///< one per point, inside units; NaN: no value there
};

}  // namespace clsurf
