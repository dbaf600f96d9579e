#pragma once
// Field: one number per point that can be coloured, plotted and exported, with what it means.

#include <cstdint>
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

/// A unit that owns its name: that of a channel is known only when its log is read.
struct FieldUnit {
    std::string name;       ///< "mm/min"; empty: none
    double per_inside = 1;  ///< shown = inside · per_inside

    FieldUnit() = default;
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
};

struct Field {
    FieldInfo info;
    Column<float> values;  ///< one per point, inside units; NaN: no value there
};

}  // namespace clsurf
