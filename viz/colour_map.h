#pragma once
// Colour maps: values → RGB. Pure numbers, no OpenGL.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clsurf::viz {

using Rgb = std::array<std::uint8_t, 3>;

struct ColourStop {
    double at;  ///< 0 … 1, rising
    Rgb rgb;
};

/// Colours between stops are linear in RGB.
class ColourMap {
public:
    ColourMap() = default;
    /// At least two stops, from 0 to 1. `centred`: the middle stands for the value 0.
    ColourMap(std::string name, std::vector<ColourStop> stops, bool centred = false);
    /// Values below and above the range get these colours, in place of those of the ends.
    void set_beyond(Rgb below, Rgb above);
    /// Its colours between two places, 0 ≤ from < to ≤ 1, over the whole range.
    [[nodiscard]] ColourMap part(double from, double to) const;
    /// The same colours from the other end.
    [[nodiscard]] ColourMap reversed() const;

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] bool centred() const { return centred_; }
    /// x in 0 … 1; outside it the nearest end.
    [[nodiscard]] Rgb at(double x) const;
    /// Of values below and above the range.
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

/// A named map, one from its other end ("magma_r"), or own stops, evenly spaced: "#0000ff,#00ff00,#ff0000". Throws
/// UsageError.
[[nodiscard]] ColourMap make_colour_map(const std::string& text);

/// "#rrggbb" or "rrggbb", or "white", "black". Throws UsageError, naming `option`.
[[nodiscard]] Rgb parse_colour(const std::string& text, const std::string& option);

/// The colour of points without a value: outside every map.
inline constexpr Rgb missing_colour{150, 150, 150};

/// Values → colours over a range, in steps where `bins` > 0. Where a centred map's range goes from
/// below 0 to above, 0 has the map's middle colour and both sides the same steepness: an uneven range
/// shows less of the map on its shorter side.
struct ColourScale {
    ColourMap map;
    double low = 0, high = 1;  ///< in shown units
    int bins = 0;
    double slack = 0;  ///< as far beyond an end a value still has the end's colour, in shown units

    /// A value in shown units; NaN: missing_colour; outside the range: the map's colours for that. high ≤ low: the middle
    /// of the map.
    [[nodiscard]] Rgb colour(double value) const;
    [[nodiscard]] bool is_below(double value) const { return high > low && value < low - slack; }
    [[nodiscard]] bool is_above(double value) const { return high > low && value > high + slack; }

    /// The colour below the range, the colours from low to high, evenly spaced (`bins` steps, or enough that between two of
    /// them the map is straight), and the colour above it.
    [[nodiscard]] std::vector<Rgb> ramp() const;
    /// Where a value lies on ramp() as a texture of one row: 0 … 1 from edge to edge,
    /// beyond it outside the range. Domain: no NaN.
    [[nodiscard]] double along(double value) const;
};

/// Round tick values in [low, high], about `wanted` of them (steps of 1, 2, 5 · 10^n).
[[nodiscard]] std::vector<double> nice_ticks(double low, double high, int wanted);
/// The tick's text with as many decimals as its step needs, and the minus sign of all pictures, "−0.5".
[[nodiscard]] std::string tick_text(double value, double step);

}  // namespace clsurf::viz
