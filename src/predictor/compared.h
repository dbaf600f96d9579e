#pragma once
// Compared: the quantities that adjacent passes are compared by, at a location on a pass.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "predictor/signals.h"
#include "surface/path_location.h"

namespace clsurf {

enum class Quantity : std::uint8_t { speed, acceleration, lag, relief };
inline constexpr std::size_t quantities = 4;
[[nodiscard]] constexpr std::size_t index_of(Quantity q) { return static_cast<std::size_t>(q); }
[[nodiscard]] std::string_view name_of(Quantity quantity);  ///< "speed"

/// What is compared, at a place.
struct Compared {
    float speed, lag, relief;
    Eigen::Vector3f acceleration;
};

/// Points of cut passes.
struct ComparedPoints {
    PointIndex away_from_ends = 0;  ///< of their passes, as far as those are judged
    PointIndex compared = 0;        ///< of these, with a neighbour on both sides

    ComparedPoints& operator+=(const ComparedPoints& other) {
        away_from_ends += other.away_from_ends;
        compared += other.compared;
        return *this;
    }
};

/// The signals at a location, linear between the points. Heights are counted along `normal`: normals of
/// walls that lean by less than 0.75° turn round with the feed.
[[nodiscard]] Compared compared_at(const Signals& signals, const PathLocation& at, const Eigen::Vector3f& normal);

}  // namespace clsurf
