// clsurf plot: signal curves over time or path length.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/fields.h"
#include "cli/picture_output.h"
#include "cli/profile.h"
#include "core/file_name.h"
#include "viz/chart.h"

namespace clsurf::cli {
namespace {

struct PlotOptions {
    PartOptions part;
    std::string output;
    std::vector<std::string> fields;
    bool over_length = false;
    std::optional<double> from, to;  ///< [s], or [mm] over length
    std::optional<LineNumber> line;
    std::vector<PointIndex> points;
    viz::ChartLook look;
};

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
    if (values.count("size") > 0) {
        const std::vector<double> size = read_size(values["size"].as<std::string>());
        options.look.width = static_cast<int>(size[0]);
        options.look.height = static_cast<int>(size[1]);
    }
    if (values.count("gl") > 0) options.look.gl = values["gl"].as<std::string>();
    return options;
}

/// x of every point: time [s], or way from the first point [mm].
std::vector<double> x_values(const Part& part, bool over_length) {
    const PointIndex count = part.log.records;
    std::vector<double> x(static_cast<std::size_t>(count));
    if (!over_length) {
        for (PointIndex i = 0; i < count; ++i) x[static_cast<std::size_t>(i)] = part.log.time_of(i);
        return x;
    }
    const Positions positions = gather(part.path);
    for (PointIndex i = 1; i < count; ++i) {
        const double step = (positions[i] - positions[i - 1]).norm();
        x[static_cast<std::size_t>(i)] = x[static_cast<std::size_t>(i - 1)] + (step == step ? step : 0.0);
    }
    return x;
}

/// The points to show: from --from to --to, or the stretch of --line with as much on both sides.
PointRange shown_range(const PlotOptions& options, const Part& part, const std::vector<double>& x) {
    const auto last = static_cast<PointIndex>(x.size()) - 1;
    PointRange range{0, last};
    if (options.line) {
        const std::vector<PointRange> runs = part.lines->points_of(*options.line);
        if (runs.empty()) throw UsageError(fmt::format("--line {}: the log has no point of that line", *options.line));
        const PointIndex room = std::max<PointIndex>(50, runs.back().last - runs.front().first + 1);
        range = {std::max<PointIndex>(0, runs.front().first - room), std::min(last, runs.back().last + room)};
    }
    if (options.from)
        range.first = std::max(
            range.first, static_cast<PointIndex>(std::lower_bound(x.begin(), x.end(), *options.from) - x.begin()));
    if (options.to)
        range.last = std::min(
            range.last, static_cast<PointIndex>(std::upper_bound(x.begin(), x.end(), *options.to) - x.begin()) - 1);
    if (range.size() < 2) throw UsageError("--from and --to leave no points to draw");
    return range;
}

ExitCode run_plot(const po::variables_map& values) {
    PlotOptions options = read_plot_options(values);
    if (asks_for_profile(values)) return plot_profile(values, options.part, options.look, options.output);
    PictureOutput output(options.output);
    StageClock clock(read_common(values), 5);
    const Part part = load_part(options.part, clock);
    print(part.diagnostics, values);
    clock.begin("stitch the surface");
    const ClSurface surface = stitch(part);
    Fields fields(part, surface);
    const std::vector<double> x = x_values(part, options.over_length);
    const PointRange range = shown_range(options, part, x);
    if (options.line) options.points.push_back(part.lines->points_of(*options.line).front().first);
    std::vector<viz::Curve> curves;
    std::vector<viz::ChartCursor> cursors;
    for (const PointIndex point : options.points) {
        if (point < 0 || point >= part.log.records)
            throw UsageError(fmt::format("point {}: the log has points 0 … {}", point, part.log.records - 1));
        cursors.push_back({x[static_cast<std::size_t>(point)],
                           fmt::format("point {}, line {}", point, part.lines->line_at(point)),
                           {}});
    }
    std::string note;
    for (const std::string& name : options.fields) {
        const Field field = fields.get(name);
        viz::Curve curve;
        curve.label =
            field.info.label + (field.info.unit.name.empty() ? "" : fmt::format(" ({})", field.info.unit.name));
        for (PointIndex i = range.first; i <= range.last; ++i)
            curve.values.push_back(field.values[static_cast<std::size_t>(i)] * field.info.unit.per_inside);
        for (std::size_t k = 0; k < cursors.size(); ++k) {
            cursors[k].values.push_back(field.values[static_cast<std::size_t>(options.points[k])] *
                                        field.info.unit.per_inside);
        }
        if (!field.info.note.empty()) note += (note.empty() ? "" : "; ") + name + ": " + field.info.note;
        curves.push_back(std::move(curve));
    }
    options.look.title = "Signals along " + file_name(options.part.log);
    options.look.subtitle =
        fmt::format("{}{}points {} to {}, {} positions", file_name(options.part.program),
                    options.part.program.empty() ? "" : " · ", range.first, range.last, name_of(part.path.role));
    options.look.x_label = options.over_length ? "path length (mm)" : "time (s)";
    options.look.footnote = note;
    clock.begin("draw");
    const std::span<const double> shown_x(x.data() + range.first, static_cast<std::size_t>(range.size()));
    output.write(viz::draw_chart(shown_x, curves, cursors, options.look), options.look.title);
    return ExitCode::done;
}

}  // namespace

Subcommand plot_subcommand() {
    return {
        .name = "plot",
        .arguments = "[PROGRAM] LOG -o curve.png",
        .summary = "signal curves over time or path length",
        .description =
            "One chart a field, stacked, every extreme kept however long the log is. A log can be plotted without its\n"
            "program, but for --profile. --profile prints Ra and Rz, too.\n\n"
            "  clsurf plot part.nc run.biip -o curve.png --fields speed,acceleration --line 1204\n"
            "  clsurf plot part.nc run.biip -o cut.png --profile 10,0,10,5 --tool ball:6",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("output,o", po::value<std::string>()->value_name("FILE"), "the picture: .png, .jpg, .tif or .webp")
                    ("fields", po::value<std::string>()->value_name("FIELD,…"), "what is drawn (default: speed; `clsurf help fields`)")
                    ("over", po::value<std::string>()->value_name("time|length"), "what x is (default: time)")
                    ("from", po::value<double>()->value_name("X"), "first x to show [s or mm]")
                    ("to", po::value<double>()->value_name("X"), "last x to show [s or mm]")
                    ("line", po::value<long long>()->value_name("N"), "show the points of a line and some round them; a cursor at its first point")
                    ("mark-point", po::value<std::vector<long long>>()->value_name("N"), "a cursor at a point; may be repeated")
                    ("size", po::value<std::string>()->value_name("WxH|hd|4k"), "size in pixels (default: 1600x900)")
                    ("gl", po::value<std::string>()->value_name("osmesa|egl"), "what draws: the processor, or a graphics card (default: osmesa)");
                // clang-format on
                declare_profile(options);
                declare_json(options);
                declare_part(options);
                declare_derivative(options);
            },
        .positional = {"PROGRAM", "LOG"},
        .run = run_plot,
    };
}

}  // namespace clsurf::cli
