#pragma once
// Internal units: mm, s, rad; speeds mm/s. Only these factors convert, and only at the edges (program text, command
// line, pictures, files).

#include <numbers>
#include <string_view>

namespace clsurf {

inline constexpr double mm_per_inch = 25.4;
inline constexpr double seconds_per_minute = 60.0;
inline constexpr double um_per_mm = 1000.0;
inline constexpr double deg_per_turn = 360.0;
inline constexpr double rad_per_deg = std::numbers::pi / 180.0;
inline constexpr double deg_per_rad = 180.0 / std::numbers::pi;

/// A unit as shown to people: its name, and its number per internal unit.
struct Unit {
    std::string_view name;  ///< "mm/min"
    double per_inside = 1;  ///< shown = inside · per_inside
    friend bool operator==(const Unit&, const Unit&) = default;
};

namespace unit {
inline constexpr Unit none{"", 1};
inline constexpr Unit mm{"mm", 1};
inline constexpr Unit um{"µm", um_per_mm};
inline constexpr Unit s{"s", 1};
inline constexpr Unit deg{"deg", deg_per_rad};
inline constexpr Unit per_mm{"1/mm", 1};
inline constexpr Unit percent{"%", 100};
inline constexpr Unit mm_min{"mm/min", seconds_per_minute};
inline constexpr Unit mm_s2{"mm/s²", 1};
inline constexpr Unit mm_s3{"mm/s³", 1};
}  // namespace unit

}  // namespace clsurf
