#pragma once
// MeasuredData: the measurement of a finished part, in the axes of the instrument, in mm.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry.h"

namespace clsurf {

enum class MeasuredKind : std::uint8_t {
    profile,  ///< heights along a line: y is 0
    points,   ///< places in space, as from a coordinate measuring machine
    areal,    ///< heights over a grid
};
/// "profile", "points", "areal map".
[[nodiscard]] constexpr std::string_view name_of(MeasuredKind kind) {
    constexpr std::string_view names[] = {"profile", "points", "areal map"};
    return names[static_cast<std::size_t>(kind)];
}

struct MeasuredData {
    MeasuredKind kind = MeasuredKind::points;
    std::string name;  ///< of its file
    /// [mm] A profile by increasing x; a map row by row, z NaN if nothing was measured there. No other value is NaN.
    std::vector<Vec3> points;
    std::int64_t columns = 0, rows = 0;  ///< of a map
    Vec2 spacing = Vec2::Zero();         ///< [mm] of a map's columns and rows
    std::size_t missing = 0;             ///< places without a height
};

}  // namespace clsurf
