#include "cli/pictures/plot_options.h"

#include <fmt/format.h>

#include "cli/pictures/plot_profile.h"
#include "core/error.h"

namespace clsurf::cli {

void declare_plot(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("output,o", po::value<std::string>()->value_name("FILE"), "the picture: .png, .jpg, .tif, .webp, .svg or .pdf")
        ("fields", po::value<std::string>()->value_name("FIELD,…"), "fields to draw (default: speed; `clsurf help fields`)")
        ("over", po::value<std::string>()->value_name("time|length"), "quantity on the x axis (default: time)")
        ("from", po::value<double>()->value_name("X"), "first x to show [s or mm]")
        ("to", po::value<double>()->value_name("X"), "last x to show [s or mm]")
        ("line", po::value<long long>()->value_name("N"), "show the points of a line and some before and after; a cursor at its first point")
        ("mark-point", po::value<std::vector<long long>>()->value_name("N"), "a cursor at a point; may be repeated")
        ("defect", po::value<long long>()->value_name("N"), "instead of curves, the card of a defect of `clsurf check`: where it is, and speed and height of its pass next to the adjacent passes; with the tool, its contact point and its height in the as-machined surface")
        ("size", po::value<std::string>()->value_name("WxH|hd|4k"), "size in pixels (default: 1600x900; of a card 1600x760)")
        ("gl", po::value<std::string>()->value_name("osmesa|egl"), "renderer: osmesa uses the processor, egl a graphics card (default: osmesa)");
    // clang-format on
    declare_profile(options);
    declare_json(options);
    declare_part(options);
    declare_derivative(options);
}

PlotOptions read_plot_options(const po::variables_map& values) {
    PlotOptions options;
    options.part = read_part_or_log_options(values);
    options.output = required(values, "output");
    options.fields = split_names(values.count("fields") > 0 ? values["fields"].as<std::string>() : "speed");
    if (options.fields.empty() || options.fields.size() > 8)
        throw UsageError("--fields: 1 to 8 names separated by commas");
    const std::string over = values.count("over") > 0 ? values["over"].as<std::string>() : "time";
    if (over != "time" && over != "length") throw UsageError("--over: '" + over + "' is not time or length");
    options.over_length = over == "length";
    if (values.count("from") > 0) options.from = values["from"].as<double>();
    if (values.count("to") > 0) options.to = values["to"].as<double>();
    if (options.from && options.to && !(*options.from < *options.to)) throw UsageError("--from must be less than --to");
    if (values.count("line") > 0) {
        const long long line = values["line"].as<long long>();
        if (line < 1 || line > 0xffffffffLL) throw UsageError("--line: lines count from 1");
        options.line = static_cast<LineNumber>(line);
    }
    if (values.count("mark-point") > 0) {
        for (const long long n : values["mark-point"].as<std::vector<long long>>()) options.points.push_back(n);
    }
    if (values.count("defect") > 0) {
        options.defect = values["defect"].as<long long>();
        for (const char* name : {"fields", "over", "from", "to", "line", "mark-point", "profile"}) {
            if (given(values, name)) throw UsageError(fmt::format("--{} does not apply to --defect", name));
        }
        options.look.height = 760;
    }
    if (values.count("size") > 0) {
        const std::vector<double> size = read_size(values["size"].as<std::string>());
        options.look.width = static_cast<int>(size[0]);
        options.look.height = static_cast<int>(size[1]);
    }
    if (values.count("gl") > 0) options.look.gl = values["gl"].as<std::string>();
    return options;
}

}  // namespace clsurf::cli
