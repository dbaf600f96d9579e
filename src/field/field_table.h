#pragma once
// The table of fields: what a field is called, what it needs and how it is computed.

#include <span>
#include <string_view>

#include "core/point.h"
#include "field/field.h"

namespace clsurf {

/// What the kernels of a block can use: positions and derivatives of the shown role, both ends of
/// the following error. All in mm and s; only what the row needs is filled.
struct FieldBlock {
    const double* position[3];
    const double* velocity[3];
    const double* acceleration[3];
    const double* jerk[3];
    const double* commanded[3];
    const double* measured[3];
    const double* uncertainty;
    PointIndex first = 0;  ///< of the block
    std::size_t count = 0;
    double period = 0;
};

namespace needs {
inline constexpr unsigned position = 1, velocity = 2, acceleration = 4, jerk = 8, error = 16;
/// In place of positions: the angle of the rotary axis whose letter ends the row's name [rad], as the
/// first component; the unit vector of the tool axis.
inline constexpr unsigned angle = 32, tool_axis = 64;
/// Standard deviation that the Kalman smoother leaves of the derivative that the row needs.
inline constexpr unsigned uncertainty = 128;
}  // namespace needs

struct FieldRow {
    std::string_view name, label;
    Unit unit;
    FieldScale scale;
    unsigned needs;
    void (*compute)(const FieldBlock& block, float* out);
};

[[nodiscard]] std::span<const FieldRow> field_table();
[[nodiscard]] const FieldRow* find_field_row(std::string_view name);

}  // namespace clsurf
