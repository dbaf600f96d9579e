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
    /// At least two stops, from 0 to 1.
    ColourMap(std::string name, std::vector<ColourStop> stops);

    [[nodiscard]] const std::string& name() const { return name_; }
    /// x in 0 … 1; outside it the nearest end.
    [[nodiscard]] Rgb at(double x) const;

private:
    std::string name_;
    std::vector<ColourStop> stops_;
};

struct ColourMapInfo {
    std::string_view name, summary;
};
/// The named maps, in the order of the help text.
[[nodiscard]] std::span<const ColourMapInfo> colour_maps();

/// A named map, or own stops, evenly spaced: "#0000ff,#00ff00,#ff0000". Throws UsageError.
[[nodiscard]] ColourMap make_colour_map(const std::string& text);

/// "#rrggbb" or "rrggbb", or "white", "black". Throws UsageError, naming `option`.
[[nodiscard]] Rgb parse_colour(const std::string& text, const std::string& option);

/// The colour of points without a value: outside every map.
inline constexpr Rgb missing_colour{150, 150, 150};

/// Values → colours over a range, in steps where `bins` > 0.
struct ColourScale {
    ColourMap map;
    double low = 0, high = 1;  ///< in shown units
    int bins = 0;

    /// A value in shown units; NaN: missing_colour. high ≤ low: the middle of the map.
    [[nodiscard]] Rgb colour(double value) const;
};

/// Round tick values in [low, high], about `wanted` of them (steps of 1, 2, 5 · 10^n).
[[nodiscard]] std::vector<double> nice_ticks(double low, double high, int wanted);
/// The tick's text with as many decimals as its step needs.
[[nodiscard]] std::string tick_text(double value, double step);

}  // namespace clsurf::viz
