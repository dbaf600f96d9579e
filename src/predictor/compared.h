#pragma once
// Compared: the quantities by which adjacent passes are compared, at a location on a pass.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "predictor/signals.h"
#include "surface/path_location.h"

namespace clsurf {

/// In reports, the normal deviation is called lag (name_of).
enum class Quantity : std::uint8_t { speed, acceleration, normal_deviation, relief };
inline constexpr std::size_t quantities = 4;
[[nodiscard]] constexpr std::size_t index_of(Quantity q) { return static_cast<std::size_t>(q); }
[[nodiscard]] std::string_view name_of(Quantity quantity);  ///< "speed"

/// The compared quantities at one place.
struct Compared {
    float speed, normal_deviation, relief;
    Eigen::Vector3f acceleration;
};

/// Numbers of points of cut passes.
struct ComparedPoints {
    PointIndex away_from_ends = 0;  ///< away from the ends of their passes, so that they are judged
    PointIndex compared = 0;        ///< number of these with a neighbour on both sides

    ComparedPoints& operator+=(const ComparedPoints& other) {
        away_from_ends += other.away_from_ends;
        compared += other.compared;
        return *this;
    }
};

/// The signals at a location, interpolated linearly between the points. Heights count along `normal`, because normals of walls
/// that lean by less than 0.75° reverse with the feed.
[[nodiscard]] Compared compared_at(const Signals& signals, const PathLocation& at, const Eigen::Vector3f& normal);

}  // namespace clsurf
