#pragma once
// Field: one number per point that can be coloured, plotted and exported, with its description.

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

/// Which end of a sequential field is good: a picture shows it light.
enum class FieldPreference : std::uint8_t { none, lower, higher };

/// A range of values, in internal units.
struct ValueRange {
    double low = 0, high = 0;
};

/// The meaning of one value of a field whose values are classes: a limit, a cause, a kind of motion.
struct FieldClass {
    float value = 0;
    std::string name;
    bool good = false;  ///< no problem: pictures show it in light grey
};

/// A unit that owns its name: the unit of a channel is known only after its log is read.
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
    std::string name;   ///< "speed", as given to --color
    std::string label;  ///< "Path speed"
    FieldUnit unit;     ///< as shown; values are stored in internal units
    FieldScale scale = FieldScale::sequential;
    std::string note;                    ///< how it was computed, "21-point window (20 ms)"; may be empty
    char axis = 0;                       ///< 'x' … 'c' of a component; 0: of all axes together
    std::vector<std::string> also = {};  ///< synonyms: "velocity"
    int report_rank = 0;                 ///< rank among the default fields of a report, from 1; 0: not among them
    bool percentiles = false;            ///< reports give the percentiles of its absolute value
    FieldPreference preference = FieldPreference::none;
    std::vector<FieldClass> classes = {};  ///< meanings of the classes; empty: values are numbers
    std::string class_word = {};           ///< name of the discrete things that values number: "line"
    /// The fixed range of its colours, so that pictures of different runs can be compared; nullopt: the data
    /// determine it (range.h).
    std::optional<ValueRange> usual_range = {};
    double slack = 0;                 ///< distance beyond usual_range that still counts as its end, internal units
    double least_span = 0;            ///< least span of the colours, internal units: smaller differences do not matter
    double least_span_of_median = 0;  ///< likewise, as a share of the median
    /// Difference that counts as a discontinuity if some consecutive points exceed it, internal units; 0: none.
    double threshold = 0;
};

/// Whether values are classes or discrete numbers: there is nothing between two of them.
[[nodiscard]] inline bool has_classes(const FieldInfo& info) {
    return !info.classes.empty() || !info.class_word.empty();
}

struct Field {
    FieldInfo info;
    Column<float> values;  ///< one per point, internal units; NaN: no value there
};

}  // namespace clsurf
