#pragma once
// FieldRow: one field of positions as a row: its name, its inputs and its computation. field_table.cpp has the built-in
// ones; PositionFields (position_fields.h) computes any.

#include <array>
#include <span>
#include <string_view>

#include "core/point.h"
#include "field/field.h"

namespace clsurf {

/// Inputs of a kernel. All in mm and s; for rotary axes in rad.
namespace needs {
inline constexpr unsigned position = 1, velocity = 2, acceleration = 4, jerk = 8;
/// Both terms of the following error: commanded positions, and measured ones at the same time.
inline constexpr unsigned commanded = 16, measured = 32, error = commanded | measured;
/// Standard deviations of derivatives by the Kalman smoother, and of each coordinate of fused positions.
inline constexpr unsigned velocity_sigma = 64, acceleration_sigma = 128, jerk_sigma = 256;
inline constexpr unsigned time = 512;  ///< since the first record
inline constexpr unsigned derivatives = velocity | acceleration | jerk;
inline constexpr unsigned position_sigma = 1024;
inline constexpr unsigned sigmas = velocity_sigma | acceleration_sigma | jerk_sigma | position_sigma;
inline constexpr unsigned curvature = 2048;  ///< of the path, from its geometry (path_curvature.h); NaN: unknown
inline constexpr int kinds = 12;
}  // namespace needs

/// The object whose positions and derivatives the field uses.
enum class FieldSubject : std::uint8_t {
    tip,          ///< the tool tip in the workpiece
    tool_axis,    ///< the unit vector of the tool axis
    rotary_axis,  ///< one rotary axis, with its angle as the control counts it
};

struct FieldRow;

/// Inputs of kernels at consecutive points. Only the inputs in the row are available: reading anything else throws
/// std::logic_error, which names the row.
class FieldBlock {
public:
    /// Commanded positions extend this far beyond the block; at the ends of a log the last one is repeated.
    static constexpr PointIndex commanded_before = 256, commanded_after = 8;

    using Vector = std::array<const double*, 3>;  ///< x, y, z, `count()` values each

    FieldBlock(const FieldRow& row, std::size_t count) : row_(&row), count_(count) {}

    [[nodiscard]] std::size_t count() const { return count_; }
    /// All three components of the input of one bit of `needs`. Not for a rotary axis, which has one.
    [[nodiscard]] const Vector& vector(unsigned need) const;
    /// The component along the row's axis; for a rotary axis its only one.
    [[nodiscard]] const double* component(unsigned need) const;
    /// A standard deviation, the time, or the curvature.
    [[nodiscard]] const double* scalar(unsigned need) const;

    void set(unsigned need, const Vector& columns);

private:
    [[nodiscard]] const Vector& at(unsigned need) const;

    const FieldRow* row_;
    std::size_t count_;
    std::array<Vector, needs::kinds> columns_{};  ///< by the number of the bit; nullptr: not available
};

struct FieldRow {
    std::string_view name = {}, label = {};
    Unit unit = {};
    FieldScale scale = FieldScale::sequential;
    char axis = 0;  ///< 'x', 'y', 'z'; for a rotary axis 'a', 'b', 'c'; 0: all axes together
    FieldSubject subject = FieldSubject::tip;
    unsigned needs = 0;
    void (*compute)(const FieldBlock& block, float* out) = nullptr;  ///< `out`: block.count() values
    // As in FieldInfo:
    std::array<std::string_view, 2> also{};
    int report_rank = 0;
    bool percentiles = false;
    FieldPreference preference = FieldPreference::none;
    double least_span_of_median = 0;
};

/// The description of a row's field.
[[nodiscard]] FieldInfo info_of(const FieldRow& row);

/// The highest derivative that a row needs, 1 … 3; 0: none.
[[nodiscard]] int derivative_of(const FieldRow& row);

// Building blocks of rows.
namespace kernel {

/// A kernel from a function of one point, value(vectors…, i), with the vectors of these needs.
template <auto value, unsigned... need>
void each(const FieldBlock& block, float* out) {
    [&](const auto&... vectors) {
        for (std::size_t i = 0; i < block.count(); ++i) out[i] = static_cast<float>(value(vectors..., i));
    }(block.vector(need)...);
}

/// A kernel that gives the component along the row's axis.
template <unsigned need>
void component(const FieldBlock& block, float* out) {
    const double* const values = block.component(need);
    for (std::size_t i = 0; i < block.count(); ++i) out[i] = static_cast<float>(values[i]);
}

/// A kernel that gives a standard deviation, the time, or the curvature.
template <unsigned need>
void scalar(const FieldBlock& block, float* out) {
    const double* const values = block.scalar(need);
    for (std::size_t i = 0; i < block.count(); ++i) out[i] = static_cast<float>(values[i]);
}

}  // namespace kernel

}  // namespace clsurf
