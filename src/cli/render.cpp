// clsurf render: the quality map.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/look.h"
#include "cli/picture_output.h"
#include "cli/render_options.h"
#include "cli/shown_part.h"
#include "cli/stage_clock.h"
#include "core/file_name.h"
#include "field/range.h"
#include "viz/scene.h"

namespace clsurf::cli {
namespace {

viz::MapPanel panel_of(const Shown& shown, const RenderOptions& options, std::string caption) {
    viz::MapPanel panel;
    panel.surface = &shown.surface;
    panel.field = &shown.field;
    panel.caption = std::move(caption);
    panel.outlines = shown.defects;
    panel.place_of = [&shown](PointIndex i) { return shown.place_of(i); };
    if (shown.relief) panel.relief = &*shown.relief;
    for (const PointIndex point : options.points) {
        if (point < 0 || point >= shown.part.log.records) {
            throw UsageError(
                fmt::format("--mark-point {}: the log has points 0 … {}", point, shown.part.log.records - 1));
        }
        panel.points.push_back({point, fmt::format("point {}, line {}", point, shown.part.lines->line_at(point))});
    }
    for (const LineNumber line : options.lines) {
        std::vector<PointRange> ranges = shown.part.lines->points_of(line);
        if (ranges.empty()) throw UsageError(fmt::format("--mark-line {}: the log has no point of that line", line));
        panel.lines.push_back({std::move(ranges), fmt::format("line {}", line)});
    }
    return panel;
}

std::string counts_of(const Shown& shown) {
    PointIndex passes = 0;
    for (const Pass& pass : shown.surface.passes) passes += pass.kind == PassKind::cut ? 1 : 0;
    return fmt::format("{} points, {} passes{}", shown.part.log.records, passes,
                       shown.surface.step_over > 0 ? fmt::format(", {:.3g} mm apart", shown.surface.step_over) : "");
}

viz::MapTexts texts_of(const Shown& shown, const std::optional<Shown>& before, const RenderOptions& options,
                       const std::vector<std::string>& range_notes) {
    viz::MapTexts texts;
    texts.title = fmt::format("{}, {} {}", shown.field.info.label, name_of(shown.part.path.role),
                              options.shown.look.style == viz::Style::surface ? "surface" : "path");
    if (shown.relief) texts.title = fmt::format("{}, {}", shown.field.info.label, to_text(*shown.part.tool));
    const std::string program = file_name(options.part.program);
    // The captions of two panels name the logs.
    texts.subtitle = before ? fmt::format("{} · before: {} · after: {}", program, counts_of(*before), counts_of(shown))
                            : fmt::format("{} · {} · {}", program, file_name(options.part.log), counts_of(shown));
    if (!shown.field.info.note.empty()) texts.notes.push_back(shown.field.info.note);
    if (options.defects)
        texts.notes.push_back(shown.defects.empty() ? "no defects"
                                                    : fmt::format("{} defects, 1 the worst", shown.defects.size()));
    texts.notes.insert(texts.notes.end(), range_notes.begin(), range_notes.end());
    return texts;
}

ExitCode run_render(const po::variables_map& values) {
    const RenderOptions options = read_render_options(values);
    PictureOutput output(options.output);
    const int stages_of_a_part = options.defects ? 7 : 5;
    StageClock clock(read_common(values), stages_of_a_part * (options.before.empty() ? 1 : 2) + 3);
    Shown after = load_shown(options.part, options.field, options.defects, clock);
    if (options.part.as_machined) show_as_machined(after, options, clock);
    print(after.part.diagnostics, values);
    std::vector<viz::MapPanel> panels;
    std::optional<Shown> before;
    if (!options.before.empty()) {
        PartOptions other = options.part;
        other.log = options.before;
        before = load_shown(other, options.field, options.defects, clock);
        if (other.as_machined) show_as_machined(*before, options, clock);
        print(before->part.diagnostics, values);
        panels.push_back(panel_of(*before, options, "before: " + file_name(options.before)));
    }
    panels.push_back(panel_of(after, options, before ? "after: " + file_name(options.part.log) : ""));

    clock.begin("choose the range");
    const viz::Camera camera = viz::map_camera(panels, options.shown.look);
    warn_of_marks_outside(after, options, camera, values);
    ShownRange range = range_in_picture(after, options, camera);
    if (before) {
        const std::string note = range.note;
        range = wider(range, range_in_picture(*before, options, camera));
        if (options.shown.range.kind == RangeRule::Kind::fixed) range.note = note;
    }
    const std::vector<std::string> range_notes = notes_of(range);
    const viz::ColourScale scale = scale_of(after.field.info, range, options.shown);
    clock.begin("draw");
    const viz::Image image =
        viz::draw_map(panels, camera, scale, texts_of(after, before, options, range_notes), options.shown.look);
    clock.begin("write the picture");
    output.write(image, fmt::format("clsurf map of {} from {}: {} {:g} to {:g} {}", file_name(options.part.program),
                                    file_name(options.part.log), after.field.info.name, range.low, range.high,
                                    after.field.info.unit.name));
    return ExitCode::done;
}

}  // namespace

Subcommand render_subcommand() {
    return {
        .name = "render",
        .arguments = "PROGRAM LOG -o map.png",
        .summary = "the quality map: the CL surface coloured by speed, acceleration and more",
        .description =
            "Maps each logged point to its line, rebuilds the cutter-location surface from adjacent passes,\n"
            "colours it by a field and draws it without a display.\n\n"
            "  clsurf render part.nc run.biip -o map.png\n"
            "  clsurf render part.nc run.biip -o map.png --color acceleration --view top --range 0,800\n"
            "  clsurf render part.nc run.biip -o map.png --surface formed --tool ball:6",
        .declare = declare_render,
        .positional = {"PROGRAM", "LOG"},
        .run = run_render,
    };
}

}  // namespace clsurf::cli
