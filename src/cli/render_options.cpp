#include "cli/render_options.h"

#include "core/error.h"

namespace clsurf::cli {
namespace {

void read_as_machined(const po::variables_map& values, RenderOptions& options) {
    if (!options.part.as_machined) {
        if (given(values, "swept"))
            throw UsageError("--swept is of the formed surface only", "--surface formed --tool ball:6");
        return;
    }
    if (values.count("swept") > 0) options.swept = parse_role(values["swept"].as<std::string>());
    if (given(values, "color"))
        throw UsageError("--color is not of the formed surface: it shows micrometres over its form");
    if (given(values, "style") && options.shown.look.style != viz::Style::surface)
        throw UsageError("--style is not of the formed surface: it is drawn as one");
}

}  // namespace

void declare_render(po::options_description& options) {
    declare_part(options, true);
    declare_derivative(options);
    declare_tool(options);
    // clang-format off
    options.add_options()
        ("swept", po::value<std::string>()->value_name("commanded|feedback|actual"), "positions along which the tool moves for the as-machined surface (default: actual, else feedback, else commanded)")
        ("output,o", po::value<std::string>()->value_name("FILE"), "the picture: .png, .jpg, .tif, .webp, .svg or .pdf")
        ("color", po::value<std::string>()->value_name("FIELD"), "field that colours the surface (default: feed_share, the speed in percent of the programmed feed; speed if --range gives numbers or no feed is known; `clsurf help fields`)")
        ("mark-point", po::value<std::vector<long long>>()->value_name("N"), "mark a point with a ring; may be repeated")
        ("mark-line", po::value<std::vector<long long>>()->value_name("N"), "draw the points of a line bold; may be repeated")
        ("defects", "draw what `clsurf check` finds on a grey relief and name the twelve strongest; with --color, --before or --surface formed: outlines with numbers")
        ("before", po::value<std::string>()->value_name("LOG"), "another log of the program, drawn next to it on the same scale; what changed is drawn below both");
    // clang-format on
    declare_look(options);
}

RenderOptions read_render_options(const po::variables_map& values) {
    RenderOptions options;
    options.part = read_part_options(values);
    options.output = required(values, "output");
    options.before = text_of(values, "before", "");
    options.shown = read_look_options(values);
    // Numbers of --range are mm/min where no field is named.
    const bool of_speeds = options.shown.range.kind == RangeRule::Kind::fixed;
    options.field = text_of(values, "color", of_speeds ? "speed" : "");
    if (values.count("mark-point") > 0) {
        for (const long long n : values["mark-point"].as<std::vector<long long>>()) options.points.push_back(n);
    }
    if (values.count("mark-line") > 0) {
        for (const long long n : values["mark-line"].as<std::vector<long long>>()) {
            if (n < 1 || n > 0xffffffffLL) throw UsageError("--mark-line: lines count from 1");
            options.lines.push_back(static_cast<LineNumber>(n));
        }
    }
    options.defects = values.count("defects") > 0;
    options.defect_map =
        options.defects && !given(values, "color") && !options.part.as_machined && options.before.empty();
    options.shown.look.names = options.defect_map;
    read_as_machined(values, options);
    return options;
}

}  // namespace clsurf::cli
