#include "cli/options/look.h"

#include <fmt/format.h>

#include "core/file_name.h"
#include "viz/field_colours.h"

namespace clsurf::cli {
namespace {

RangeRule parse_range(const std::string& text) {
    RangeRule rule;
    if (text == "auto") return rule;
    std::string numbers = text;
    rule.kind = RangeRule::Kind::fixed;
    if (text.starts_with('p')) {
        rule.kind = RangeRule::Kind::percentiles;
        std::erase(numbers, 'p');
    }
    const std::vector<double> pair = parse_numbers(numbers, "--range", 2);
    rule.low = pair[0];
    rule.high = pair[1];
    if (rule.low > rule.high) throw UsageError("--range: MIN must not be above MAX");
    if (rule.kind == RangeRule::Kind::percentiles && (rule.low < 0 || rule.high > 100))
        throw UsageError("--range: percentiles are 0 … 100");
    return rule;
}

viz::Look read_look(const po::variables_map& values) {
    viz::Look look;
    const std::vector<double> size = read_size(text_of(values, "size", "1600x1200"));
    look.width = static_cast<int>(size[0]);
    look.height = static_cast<int>(size[1]);
    look.view = viz::parse_view(text_of(values, "view", "iso"));
    const std::string style = text_of(values, "style", "surface");
    if (style == "surface")
        look.style = viz::Style::surface;
    else if (style == "lines")
        look.style = viz::Style::lines;
    else if (style == "points")
        look.style = viz::Style::points;
    else
        throw UsageError("--style: '" + style + "' is not surface, lines or points");
    if (values.count("zoom") > 0) {
        const std::vector<double> n = parse_numbers(values["zoom"].as<std::string>(), "--zoom", 4);
        look.zoom = {n[0], n[1], n[2], n[3]};
        if (!(n[0] < n[2] && n[1] < n[3])) throw UsageError("--zoom: X0 < X1 and Y0 < Y1 are needed");
    }
    if (values.count("box") > 0) {
        const std::vector<double> n = parse_numbers(values["box"].as<std::string>(), "--box", 6);
        for (std::size_t k = 0; k < 3; ++k) {
            if (!(n[k] <= n[k + 3])) throw UsageError("--box: the first corner must be the lower one in X, Y and Z");
        }
        look.box = Box3(Vec3(n[0], n[1], n[2]), Vec3(n[3], n[4], n[5]));
    }
    look.background = viz::parse_colour(text_of(values, "background", "white"), "--background");
    look.legend = values.count("no-legend") == 0;
    look.scales = values.count("no-axes") == 0;
    look.gl = text_of(values, "gl", "osmesa");
    if (look.gl != "osmesa" && look.gl != "egl") throw UsageError("--gl: '" + look.gl + "' is not osmesa or egl");
    return look;
}

}  // namespace

void declare_look(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("style", po::value<std::string>()->value_name("surface|lines|points"), "how the map is drawn (default: surface)")
        ("view", po::value<std::string>()->value_name("iso|top|front|left|right|back|bottom|AZ,EL"), "view direction; AZ,EL in degrees (default: iso)")
        ("zoom", po::value<std::string>()->value_name("X0,Y0,X1,Y1"), "part of the map, as fractions from its upper left corner")
        ("box", po::value<std::string>()->value_name("X0,Y0,Z0,X1,Y1,Z1"), "part of the workpiece [mm]; the rest is left out")
        ("range", po::value<std::string>()->value_name("auto|MIN,MAX|pLOW,pHIGH"), "values at both ends of the colour scale, or percentiles of the cutting points shown (default: auto, the fixed range of the field, such as 0 to 100 % of the feed, or p1,p99 widened to include patches of 20 points and all defects)")
        ("colormap", po::value<std::string>()->value_name("COLORMAP|RGB,RGB,…"), "a named map (`clsurf help colormaps`) or your own colours, #RRGGBB,#RRGGBB,… ; NAME_r reverses a named map (default: magma for speeds, magma_r for errors, coolwarm for signed values, viridis)")
        ("bins", po::value<int>()->value_name("N"), "colours in N steps")
        ("size", po::value<std::string>()->value_name("WxH|hd|4k"), "size in pixels (default: 1600x1200)")
        ("background", po::value<std::string>()->value_name("white|black|#RRGGBB"), "background colour (default: white)")
        ("no-axes", "no scales in millimetres round the map; a scale bar instead")
        ("no-legend", "only the map: no title, legend, axes or scale bar")
        ("gl", po::value<std::string>()->value_name("osmesa|egl"), "renderer: osmesa uses the processor, egl a graphics card (default: osmesa)");
    // clang-format on
}

LookOptions read_look_options(const po::variables_map& values) {
    LookOptions options;
    options.range = parse_range(text_of(values, "range", "auto"));
    options.colour_map = text_of(values, "colormap", "");
    if (!options.colour_map.empty()) (void)viz::make_colour_map(options.colour_map);  // report wrong names early
    if (values.count("bins") > 0) {
        options.bins = values["bins"].as<int>();
        if (options.bins < 2 || options.bins > 256) throw UsageError("--bins must be 2 … 256");
    }
    options.range.bins = options.bins;
    options.look = read_look(values);
    return options;
}

viz::ColourScale scale_of(const FieldInfo& field, const ShownRange& range, const LookOptions& options) {
    if (options.colour_map.empty()) {
        const bool thin = options.look.style != viz::Style::surface;
        return viz::scale_of(field, range.low, range.high, options.bins,
                             thin ? viz::colour_map_of_lines(field) : viz::usual_colour_map(field));
    }
    return viz::scale_of(field, range.low, range.high, options.bins, viz::make_colour_map(options.colour_map));
}

void refuse_scale_options(const FieldInfo& field, const LookOptions& options) {
    const auto refuse = [&](const char* option) {
        throw UsageError(
            fmt::format("{} does not apply to '{}': its values are names, not numbers", option, field.name));
    };
    if (options.range.kind != RangeRule::Kind::automatic) refuse("--range");
    if (!options.colour_map.empty()) refuse("--colormap");
    if (options.bins > 0) refuse("--bins");
}

std::string text_of(const po::variables_map& values, const char* name, const std::string& otherwise) {
    return values.count(name) > 0 ? values[name].as<std::string>() : otherwise;
}

}  // namespace clsurf::cli
