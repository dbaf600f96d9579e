// clsurf plot: curves of signals over time or arc length.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/pictures/defect_card.h"
#include "cli/pictures/picture_output.h"
#include "cli/pictures/plot_options.h"
#include "cli/pictures/plot_profile.h"
#include "core/file_name.h"
#include "pipeline/part_fields.h"
#include "pipeline/speed_reasons.h"
#include "viz/field_classes.h"

namespace clsurf::cli {
namespace {

/// x of every point: time [s], or arc length from the first point [mm].
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

/// The shown points: from --from to --to, or the section of --line, extended by its own length on both sides.
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

/// The names of the values of a field that occur, with the colours of the map.
std::vector<viz::CurveClass> classes_of(const Field& field, const ClSurface& surface) {
    const viz::FieldClasses classes(field.info, field.values, surface.passes);
    std::vector<viz::CurveClass> all;
    for (const FieldClass& known : field.info.classes) {
        const auto occurs = [&](float value) { return value == known.value; };
        if (std::any_of(field.values.begin(), field.values.end(), occurs))
            all.push_back({known.value * field.info.unit.per_inside, known.name, classes.rgb_of(known.value)});
    }
    return all;
}

ExitCode run_plot(const po::variables_map& values) {
    PlotOptions options = read_plot_options(values);
    if (asks_for_profile(values)) return plot_profile(values, options.part, options.look, options.output);
    if (options.defect)
        return plot_defect(values, options.part, *options.defect, options.output, options.look.width,
                           options.look.height, options.look.gl);
    PictureOutput output(options.output, "-o", PictureKind::drawing);
    options.look.keep_drawing = output.wants_drawing();
    StageClock clock(read_common(values), 5);
    const Part part = load_part(options.part, clock);
    print(part.diagnostics, values);
    clock.begin("stitch the surface");
    const ClSurface surface = stitch(part);
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
    const FieldSet set = fields_of(part, surface);
    std::string note = options.part.program.empty() ? std::string() : slow_points(options.points, part, set);
    const std::vector<Field> fields = set.get_all(options.fields);
    for (std::size_t f = 0; f < fields.size(); ++f) {
        const Field& field = fields[f];
        viz::Curve curve;
        curve.label =
            field.info.label + (field.info.unit.name.empty() ? "" : fmt::format(" ({})", field.info.unit.name));
        for (PointIndex i = range.first; i <= range.last; ++i)
            curve.values.push_back(field.values[static_cast<std::size_t>(i)] * field.info.unit.per_inside);
        if (!field.info.classes.empty()) curve.classes = classes_of(field, surface);
        for (std::size_t k = 0; k < cursors.size(); ++k) {
            cursors[k].values.push_back(field.values[static_cast<std::size_t>(options.points[k])] *
                                        field.info.unit.per_inside);
        }
        if (!field.info.note.empty()) note += (note.empty() ? "" : "; ") + options.fields[f] + ": " + field.info.note;
        curves.push_back(std::move(curve));
    }
    options.look.title = "Signals along " + file_name(options.part.log);
    options.look.subtitle =
        fmt::format("{}{}points {} to {}, {} positions", file_name(options.part.program),
                    options.part.program.empty() ? "" : " · ", range.first, range.last, name_of(part.path.role));
    options.look.x_label = options.over_length ? "arc length (mm)" : "time (s)";
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
        .summary = "draws signals over time or arc length",
        .description =
            "One chart for each field, stacked. Every extreme is kept, however long the log is. A log can be\n"
            "plotted without its program, except with --profile. --profile also prints Ra and Rz.\n\n"
            "  clsurf plot part.nc run.biip -o curve.png --fields speed,acceleration --line 1204\n"
            "  clsurf plot part.nc run.biip -o card.png --defect 1\n"
            "  clsurf plot part.nc run.biip -o cut.png --profile 10,0,10,5 --tool ball:6",
        .declare = declare_plot,
        .positional = {"PROGRAM", "LOG"},
        .run = run_plot,
    };
}

}  // namespace clsurf::cli
