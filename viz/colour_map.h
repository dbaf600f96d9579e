#pragma once
// Colour maps: values → RGB. Numbers only, no OpenGL.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clsurf::viz {

using Rgb = std::array<std::uint8_t, 3>;

struct ColourStop {
    double at;  ///< 0 … 1, increasing
    Rgb rgb;
};

/// Colours between stops are interpolated linearly in RGB.
class ColourMap {
public:
    ColourMap() = default;
    /// At least two stops, from 0 to 1. `centred`: the middle is for the value 0.
    ColourMap(std::string name, std::vector<ColourStop> stops, bool centred = false);
    /// Values below and above the range get these colours instead of those of the ends.
    void set_beyond(Rgb below, Rgb above);
    /// Its colours from `from` to `to`, 0 ≤ from < to ≤ 1, stretched to the whole range.
    [[nodiscard]] ColourMap part(double from, double to) const;
    /// The same colours in reverse order.
    [[nodiscard]] ColourMap reversed() const;

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] bool centred() const { return centred_; }
    /// x in 0 … 1; outside it the nearest end.
    [[nodiscard]] Rgb at(double x) const;
    /// The colour of values below the range.
    [[nodiscard]] Rgb below() const { return below_; }
    [[nodiscard]] Rgb above() const { return above_; }

private:
    std::string name_;
    std::vector<ColourStop> stops_;
    bool centred_ = false;
    Rgb below_{}, above_{};
};

struct ColourMapInfo {
    std::string_view name, summary;
};
/// The named maps, in the order of the help text.
[[nodiscard]] std::span<const ColourMapInfo> colour_maps();

/// A named map, a reversed one ("magma_r"), or evenly spaced stops: "#0000ff,#00ff00,#ff0000". Throws
/// UsageError.
[[nodiscard]] ColourMap make_colour_map(const std::string& text);

/// "#rrggbb" or "rrggbb", or "white", "black". Throws UsageError, naming `option`.
[[nodiscard]] Rgb parse_colour(const std::string& text, const std::string& option);

/// The colour of points without a value; no map contains it.
inline constexpr Rgb missing_colour{150, 150, 150};

/// Values → colours over a range, in steps if `bins` > 0. If the map is centred and the range contains 0,
/// then 0 has the middle colour of the map and both sides have the same scale: an asymmetric range
/// shows less of the map on its shorter side.
struct ColourScale {
    ColourMap map;
    double low = 0, high = 1;  ///< in shown units
    int bins = 0;
    double slack = 0;  ///< values beyond an end by no more than this have its colour, in shown units

    /// `value` is in shown units. NaN: missing_colour; outside the range: the map's colours for such values. high ≤ low: the
    /// middle of the map.
    [[nodiscard]] Rgb colour(double value) const;
    [[nodiscard]] bool is_below(double value) const { return high > low && value < low - slack; }
    [[nodiscard]] bool is_above(double value) const { return high > low && value > high + slack; }

    /// The colour below the range, evenly spaced colours from low to high, and the colour above the range. With `bins`, one
    /// colour per step; otherwise enough that the map is linear between two of them.
    [[nodiscard]] std::vector<Rgb> ramp() const;
    /// The position of a value on ramp() as a texture of one row: 0 … 1 from edge to edge,
    /// outside that interval if far outside the range. Domain: not NaN.
    [[nodiscard]] double along(double value) const;
};

/// Round tick values in [low, high], about `wanted` of them (steps of 1, 2, 5 · 10^n).
[[nodiscard]] std::vector<double> nice_ticks(double low, double high, int wanted);
/// The text of a tick with the decimals that its step needs, and the minus sign of all pictures, "−0.5".
[[nodiscard]] std::string tick_text(double value, double step);

}  // namespace clsurf::viz
