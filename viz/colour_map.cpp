#include "viz/colour_map.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "core/decimal_text.h"
#include "core/error.h"
#include "core/spelling.h"

namespace clsurf::viz {
namespace {

constexpr auto infos = std::to_array<ColourMapInfo>({
    {"magma", "black, purple, orange, cream: even in lightness, readable by the colour-blind; for speeds"},
    {"isurface", "blue, cyan, green, yellow, red: the gradient of Wu et al. 2022"},
    {"gray", "black to white"},
    {"viridis", "even in lightness, readable by the colour-blind"},
    {"cividis", "even in lightness, the same for the colour-blind"},
    {"turbo", "rainbow with smooth lightness"},
    {"coolwarm", "blue, white, red: signed values, white at 0"},
});

// Samples of the published maps (magma, viridis: Smith, van der Walt 2015; cividis: Nuñez, Anderton, Renslow
// 2018; turbo: Mikhailov 2019; coolwarm: Moreland 2009), evenly spaced.
constexpr auto magma = std::to_array<std::uint32_t>(
    {0x000004, 0x07061b, 0x150e37, 0x261256, 0x3b0f70, 0x50127c, 0x641a80, 0x782281, 0x8c2981, 0xa1307e, 0xb63779,
     0xca3e72, 0xde4968, 0xed5a5f, 0xf66f5c, 0xfb8761, 0xfe9f6d, 0xfeb77e, 0xfece91, 0xfde6a7, 0xfcfdbf});
constexpr auto viridis = std::to_array<std::uint32_t>(
    {0x440154, 0x481467, 0x482576, 0x453781, 0x404688, 0x39558c, 0x33638d, 0x2d718e, 0x287d8e, 0x238a8d,
     0x1f968b, 0x20a386, 0x29af7f, 0x3dbc74, 0x56c667, 0x75d054, 0x95d840, 0xbade28, 0xdde318, 0xfde725});
constexpr auto cividis = std::to_array<std::uint32_t>({0x00224e, 0x002c69, 0x1a386f, 0x31446b, 0x434e6c, 0x53596d,
                                                       0x616571, 0x6f7073, 0x7d7c78, 0x8c8979, 0x9b9677, 0xaba274,
                                                       0xbbaf6f, 0xccbe68, 0xddcc5e, 0xefda4f, 0xfee838});
constexpr auto turbo =
    std::to_array<std::uint32_t>({0x30123b, 0x4145ab, 0x4675ed, 0x39a2fc, 0x1bcfd4, 0x24eca6, 0x61fc6c, 0xa4fc3b,
                                  0xd1e834, 0xf3c63a, 0xfe9b2d, 0xf36315, 0xd93806, 0xb11901, 0x7a0402});
constexpr auto isurface = std::to_array<std::uint32_t>({0x0000ff, 0x00ffff, 0x00ff00, 0xffff00, 0xff0000});
constexpr auto gray = std::to_array<std::uint32_t>({0x000000, 0xffffff});
constexpr auto coolwarm = std::to_array<std::uint32_t>(
    {0x3b4cc0, 0x5977e3, 0x7b9ff9, 0x9ebeff, 0xc0d4f5, 0xdddcdc, 0xf2cbb7, 0xf7ac8e, 0xee8468, 0xd65244, 0xb40426});

ColourMap from_table(std::string name, std::span<const std::uint32_t> colours, bool centred = false) {
    std::vector<ColourStop> stops;
    for (std::size_t i = 0; i < colours.size(); ++i) {
        const std::uint32_t c = colours[i];
        stops.push_back(
            {static_cast<double>(i) / static_cast<double>(colours.size() - 1),
             {static_cast<std::uint8_t>(c >> 16), static_cast<std::uint8_t>(c >> 8), static_cast<std::uint8_t>(c)}});
    }
    return {std::move(name), std::move(stops), centred};
}

/// Colours of values outside the range: none is close to a colour of the map. The map of the paper keeps the colours of its
/// ends.
struct NamedColours {
    std::string_view name;
    std::span<const std::uint32_t> colours;
    Rgb below{}, above{};
    bool ends_beyond = false;  ///< values outside the range have the colours of the ends
    bool centred = false;
};

constexpr Rgb sky{64, 176, 230};
constexpr Rgb yellow{255, 214, 10};
constexpr Rgb cyan{0, 200, 220};
constexpr Rgb pink{255, 150, 220};
constexpr Rgb magenta{225, 0, 190};

constexpr auto tables = std::to_array<NamedColours>({
    {"magma", magma, sky, sky},
    {"isurface", isurface, {}, {}, true},
    {"gray", gray, sky, magenta},
    {"viridis", viridis, pink, magenta},
    {"cividis", cividis, pink, magenta},
    {"turbo", turbo, pink, magenta},
    {"coolwarm", coolwarm, cyan, yellow, false, true},
});

constexpr int ramp_colours = 1024;  ///< finer than 8 bits for any map

}  // namespace

ColourMap::ColourMap(std::string name, std::vector<ColourStop> stops, bool centred)
    : name_(std::move(name)),
      stops_(std::move(stops)),
      centred_(centred),
      below_(stops_.front().rgb),
      above_(stops_.back().rgb) {}

void ColourMap::set_beyond(Rgb below, Rgb above) {
    below_ = below;
    above_ = above;
}

ColourMap ColourMap::part(double from, double to) const {
    ColourMap result = *this;
    result.stops_ = {{0, at(from)}};
    for (const ColourStop& stop : stops_) {
        if (stop.at > from && stop.at < to) result.stops_.push_back({(stop.at - from) / (to - from), stop.rgb});
    }
    result.stops_.push_back({1, at(to)});
    return result;
}

ColourMap ColourMap::reversed() const {
    ColourMap other = *this;
    other.name_ += "_r";
    std::reverse(other.stops_.begin(), other.stops_.end());
    for (ColourStop& stop : other.stops_) stop.at = 1 - stop.at;
    return other;
}

Rgb ColourMap::at(double x) const {
    if (!(x > 0)) return stops_.front().rgb;
    const auto above = std::find_if(stops_.begin(), stops_.end(), [&](const ColourStop& s) { return s.at >= x; });
    if (above == stops_.end()) return stops_.back().rgb;
    if (above == stops_.begin()) return above->rgb;
    const ColourStop& below = *std::prev(above);
    const double t = (x - below.at) / (above->at - below.at);
    Rgb rgb;
    for (std::size_t k = 0; k < 3; ++k) {
        rgb[k] = static_cast<std::uint8_t>(std::lround(below.rgb[k] + t * (above->rgb[k] - below.rgb[k])));
    }
    return rgb;
}

std::span<const ColourMapInfo> colour_maps() { return infos; }

Rgb parse_colour(const std::string& text, const std::string& option) {
    if (text == "white") return {255, 255, 255};
    if (text == "black") return {0, 0, 0};
    const std::string digits = text.starts_with('#') ? text.substr(1) : text;
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (digits.size() != 6 || error != std::errc() || end != digits.data() + digits.size()) {
        throw UsageError(option + ": '" + text + "' is not a colour", "write it as #rrggbb");
    }
    return {static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8),
            static_cast<std::uint8_t>(value)};
}

ColourMap make_colour_map(const std::string& text) {
    constexpr std::string_view from_the_other_end = "_r";
    if (text.ends_with(from_the_other_end) && text.find(',') == std::string::npos)
        return make_colour_map(text.substr(0, text.size() - from_the_other_end.size())).reversed();
    for (const NamedColours& table : tables) {
        if (text != table.name) continue;
        ColourMap map = from_table(text, table.colours, table.centred);
        if (!table.ends_beyond) map.set_beyond(table.below, table.above);
        return map;
    }
    if (text.find(',') == std::string::npos) {
        std::vector<std::string_view> names;
        for (const ColourMapInfo& info : infos) names.push_back(info.name);
        const std::string nearest = did_you_mean(text, names);
        throw UsageError("--colormap: unknown map '" + text + "'",
                         nearest.empty()
                             ? "a name of `clsurf help colormaps`, or your own colours: #0000ff,#ffff00,#ff0000"
                             : nearest);
    }
    std::vector<ColourStop> stops;
    std::size_t at = 0;
    while (at <= text.size()) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        stops.push_back({0, parse_colour(text.substr(at, end - at), "--colormap")});
        at = end + 1;
    }
    for (std::size_t i = 0; i < stops.size(); ++i)
        stops[i].at = static_cast<double>(i) / static_cast<double>(stops.size() - 1);
    return {text, std::move(stops)};
}

Rgb ColourScale::colour(double value) const {
    if (!(value == value)) return missing_colour;
    if (!(high > low)) return map.at(0.5);
    if (is_below(value)) return map.below();
    if (is_above(value)) return map.above();
    double x = std::clamp((value - low) / (high - low), 0.0, 1.0);
    if (bins > 0) x = (std::min(std::floor(x * bins), bins - 1.0) + 0.5) / bins;
    if (map.centred() && low < 0 && high > 0) x = 0.5 + 0.5 * (low + x * (high - low)) / std::max(-low, high);
    return map.at(x);
}

std::vector<Rgb> ColourScale::ramp() const {
    const int count = bins > 0 ? bins : ramp_colours;
    std::vector<Rgb> colours{map.below()};
    for (int k = 0; k < count; ++k) {
        // The colour of a step is that of its middle; a continuous scale includes both ends.
        const double x = bins > 0 ? (k + 0.5) / count : static_cast<double>(k) / (count - 1);
        colours.push_back(colour(low + x * (high - low)));
    }
    colours.push_back(map.above());
    return colours;
}

double ColourScale::along(double value) const {
    if (!(high > low)) return 0.5;
    // Not clamped at the ends, for linear interpolation between a vertex inside and one outside the range.
    constexpr double far = 1e6;
    double x = std::clamp((value - low) / (high - low), -far, far);
    if (!is_below(value) && !is_above(value)) x = std::clamp(x, 0.0, 1.0);
    if (bins > 0) {
        // The upper end of the range belongs to its last step.
        constexpr double inside = 1 - 1e-6;
        if (x >= inside && !is_above(value)) x = inside;
        return (1 + x * bins) / (bins + 2);
    }
    return (1.5 + x * (ramp_colours - 1)) / (ramp_colours + 2);
}

std::vector<double> nice_ticks(double low, double high, int wanted) {
    if (!(high > low) || !std::isfinite(high - low)) return {low};
    const double raw = (high - low) / std::max(1, wanted);
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    double step = 10 * power;
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= raw * 0.999) {
            step = factor * power;
            break;
        }
    }
    std::vector<double> ticks;
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1)
        ticks.push_back(k == 0 ? 0.0 : k * step);
    return ticks;
}

std::string tick_text(double value, double step) {
    std::string text;
    if (std::max(std::abs(value), step) >= 1e6 || step < 1e-5) {
        text = fmt::format("{:.3g}", value + 0.0);  // −0 + 0 is 0
    } else {
        const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
        text = fixed_text(value, decimals);
    }
    return text.starts_with('-') ? "−" + text.substr(1) : text;
}

}  // namespace clsurf::viz
