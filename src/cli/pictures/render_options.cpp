#include "cli/pictures/render_options.h"

#include <charconv>
#include <string_view>

#include "cli/options/follow.h"
#include "core/error.h"

namespace clsurf::cli {
namespace {

void read_as_machined(const po::variables_map& values, RenderOptions& options) {
    if (!options.part.as_machined) {
        if (given(values, "swept"))
            throw UsageError("--swept needs the as-machined surface", "--surface formed --tool ball:6");
        return;
    }
    if (values.count("swept") > 0) options.swept = parse_role(values["swept"].as<std::string>());
    if (given(values, "color"))
        throw UsageError("--color does not apply to the as-machined surface, which shows its height over the form");
    if (given(values, "style") && options.shown.look.style != viz::Style::surface)
        throw UsageError("--style does not apply to the as-machined surface, which is drawn as a surface");
}

/// "A..B", "A..", "..B" or "N".
NumberRange parse_range(const std::string& option, const std::string& text, std::int64_t least) {
    const auto wrong = [&] {
        return UsageError("--" + option + ": '" + text + "' is not a range of whole numbers",
                          "A..B, A.., ..B or a single number");
    };
    const auto number = [&](std::string_view digits, std::int64_t otherwise) {
        if (digits.empty()) return otherwise;
        std::int64_t value = 0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error != std::errc() || end != digits.data() + digits.size()) throw wrong();
        return value;
    };
    const std::string_view all(text);
    const std::size_t dots = all.find("..");
    NumberRange range;
    if (dots == std::string_view::npos) {
        if (all.empty()) throw wrong();
        range.first = range.last = number(all, 0);
    } else {
        if (all == "..") throw wrong();
        range.first = number(all.substr(0, dots), least);
        range.last = number(all.substr(dots + 2), range.last);
    }
    if (range.first < least) throw UsageError("--" + option + ": they are counted from " + std::to_string(least));
    if (range.last < range.first) throw UsageError("--" + option + ": '" + text + "' ends before it begins");
    return range;
}

Selection read_selection(const po::variables_map& values) {
    Selection selection;
    const auto read = [&](const char* option, std::int64_t least, std::optional<NumberRange>& range) {
        if (values.count(option) == 0) return;
        const std::string text = values[option].as<std::string>();
        range = parse_range(option, text, least);
        if (!selection.words.empty()) selection.words += ", ";
        selection.words += std::string(option) + " " + text;
    };
    read("points", 0, selection.points);
    read("lines", 1, selection.lines);
    read("passes", 1, selection.passes);
    return selection;
}

void refuse_selection(const RenderOptions& options) {
    if (options.selection.is_all()) return;
    if (options.part.as_machined)
        throw UsageError("--points, --lines and --passes do not apply to the as-machined surface", "--box cuts it");
    if (options.defects)
        throw UsageError("--points, --lines and --passes do not apply to --defects",
                         "--box shows the defects of a region");
    if (!options.before.empty())
        throw UsageError("--points, --lines and --passes do not apply to --before",
                         "--box shows a region of both logs");
}

}  // namespace

void declare_render(po::options_description& options) {
    declare_part(options, MachineUse::simulation);
    declare_derivative(options);
    declare_tool(options);
    // clang-format off
    options.add_options()
        ("swept", po::value<std::string>()->value_name("commanded|feedback|actual"), "positions along which the tool moves for the as-machined surface (default: actual, else feedback, else commanded)")
        ("output,o", po::value<std::string>()->value_name("FILE"), "the picture: .png, .jpg, .tif, .webp, .svg or .pdf")
        ("color", po::value<std::string>()->value_name("FIELD"), "field that colours the surface (default: feed_share, the speed in percent of the programmed feed; speed if --range gives numbers or no feed is known; `clsurf help fields`)")
        ("mark-point", po::value<std::vector<long long>>()->value_name("N"), "mark a point with a ring; may be repeated")
        ("mark-line", po::value<std::vector<long long>>()->value_name("N"), "draw the points of a line bold; may be repeated")
        ("points", po::value<std::string>()->value_name("A..B"), "show these points of the log only; A.., ..B and a single number are ranges, too")
        ("lines", po::value<std::string>()->value_name("A..B"), "show the points of these lines of the program only")
        ("passes", po::value<std::string>()->value_name("A..B"), "show these passes only, counted from 1 as in `clsurf check`")
        ("programmed", "draw the path of the program, too: thin lines, below all marks")
        ("defects", "draw what `clsurf check` finds on a grey surface and name the twelve strongest; with --color, --before or --surface formed: outlines with numbers")
        ("before", po::value<std::string>()->value_name("LOG"), "another log of the program, drawn next to it on the same scale; what changed is drawn below both");
    // clang-format on
    declare_look(options);
    declare_follow(options,
                   "the log is still being written: draw the picture again every few seconds until the log ends");
}

RenderOptions read_render_options(const po::variables_map& values) {
    RenderOptions options;
    options.part = read_part_or_program_options(values);
    options.selection = read_selection(values);
    options.output = required(values, "output");
    options.before = text_of(values, "before", "");
    options.shown = read_look_options(values);
    // If no field is named, numbers of --range are in mm/min.
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
    options.programmed = values.count("programmed") > 0;
    options.defects = values.count("defects") > 0;
    options.defect_map =
        options.defects && !given(values, "color") && !options.part.as_machined && options.before.empty();
    options.shown.look.names = options.defect_map;
    read_as_machined(values, options);
    refuse_selection(options);
    if (options.part.log.empty() && !options.before.empty())
        throw UsageError("--before compares logs: PROGRAM LOG --before LOG");
    return options;
}

}  // namespace clsurf::cli
