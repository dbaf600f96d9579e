// clsurf render: the quality map.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/options/look.h"
#include "cli/pictures/change_map.h"
#include "cli/pictures/map_content.h"
#include "cli/pictures/picture_output.h"
#include "cli/pictures/render_options.h"
#include "cli/pictures/render_shards.h"
#include "cli/pictures/shown_part.h"
#include "cli/runs/followed_output.h"
#include "cli/stage_clock.h"
#include "core/file_name.h"
#include "field/range.h"
#include "io/reports/defect_names.h"
#include "viz/map_texts.h"
#include "viz/scene.h"

namespace clsurf::cli {
namespace {

/// The colour scale of the values, and its description in the picture.
struct MapScale {
    viz::ColourScale colours;
    std::vector<std::string> notes;
    std::string words;  ///< " 0 to 100 %"
    double span = 0;    ///< width of the range, in shown units; 0 for classes
};

MapScale scale_of_map(const Shown& after, const std::optional<Shown>& before, const RenderOptions& options,
                      const viz::Camera& camera) {
    if (has_classes(after.field.info)) return {after.classes.scale(), {std::string(viz::shares_note)}, "", 0};
    ShownRange range = range_in_picture(after, options, camera);
    if (before) range = wider(range, range_in_picture(*before, options, camera));
    return {scale_of(after.field.info, range, options.shown), viz::notes_of(range),
            fmt::format(" {:g} to {:g} {}", range.low, range.high, after.field.info.unit.name), range.high - range.low};
}

/// One map, or maps before and after next to each other, with the changes.
viz::Image draw_maps(const std::vector<viz::MapPanel>& panels, const Shown& after, const std::optional<Shown>& before,
                     const MapScale& scale, const RenderOptions& options) {
    viz::MapTexts texts = texts_of(after, before, options, scale.notes);
    if (const std::string roughness = before ? changed_roughness_text(*before, after) : std::string();
        !roughness.empty())
        texts.notes.insert(texts.notes.begin(), roughness);
    const auto draw = [&](const viz::Look& look) {
        return viz::draw_map(panels, viz::placed_map(panels, look), scale.colours, texts, look);
    };
    return before ? draw_with_change(*before, after, scale.span, options, draw) : draw(options.shown.look);
}

/// `last`: the log is complete. Problems of the part are only reported then.
ExitCode draw_once(RenderOptions options, const po::variables_map& values, bool last) {
    PictureOutput output(options.output, "-o", PictureKind::drawing);
    options.shown.look.keep_drawing = output.wants_drawing();
    const int stages_of_a_part = options.defects ? 7 : 5;
    StageClock clock(read_common(values), stages_of_a_part * (options.before.empty() ? 1 : 2) + 3);
    Shown after = load_shown(options.part, options.field, options.defects, clock);
    if (options.part.as_machined) show_as_machined(after, options, clock);
    show_selection(after, options.selection);
    if (options.programmed) show_programmed(after, options.part);
    if (last) print(after.part.diagnostics, values);
    if (has_classes(after.field.info)) {
        refuse_scale_options(after.field.info, options.shown);
        if (!options.before.empty() && after.field.info.classes.empty())
            throw UsageError("--before does not apply to '" + after.field.info.name + "': each log has other classes");
        options.shown.look.names = true;
    }
    if (options.defect_map) {
        warn_of_marks_outside(after, options,
                              viz::placed_map({panel_of(after, options, "")}, options.shown.look).camera, values);
        clock.begin("draw");
        const viz::Image image = draw_defect_map(after, options);
        clock.begin("write the picture");
        output.write(image, fmt::format("clsurf defects of {} from {}: {}", file_name(options.part.program),
                                        run_name(after, options), io::headline_of(after.defects.report)));
        return ExitCode::done;
    }
    std::vector<viz::MapPanel> panels;
    std::optional<Shown> before;
    if (!options.before.empty()) {
        PartOptions other = options.part;
        other.log = options.before;
        other.log_source.reset();
        before = load_shown(other, options.field, options.defects, clock);
        if (other.as_machined) show_as_machined(*before, options, clock);
        if (options.programmed) before->programmed = after.programmed;
        if (last) print(before->part.diagnostics, values);
        panels.push_back(panel_of(*before, options, "before: " + file_name(options.before)));
    }
    panels.push_back(panel_of(after, options, before ? "after: " + file_name(options.part.log) : ""));

    clock.begin("choose the range");
    const viz::Camera camera = viz::placed_map(panels, options.shown.look).camera;
    warn_of_marks_outside(after, options, camera, values);
    const MapScale shown = scale_of_map(after, before, options, camera);
    clock.begin("draw");
    const viz::Image image = draw_maps(panels, after, before, shown, options);
    clock.begin("write the picture");
    output.write(image, fmt::format("clsurf map of {} from {}: {}{}", file_name(options.part.program),
                                    run_name(after, options), after.field.info.name, shown.words));
    return ExitCode::done;
}

ExitCode run_render(const po::variables_map& values) {
    RenderOptions options = read_render_options(values);
    if (draw_in_shards(options, values)) return ExitCode::done;
    const std::optional<FollowOptions> follow = read_follow(values);
    if (!follow) return draw_once(std::move(options), values, true);
    return update_while_growing(options.part, *follow, options.output,
                                [&](bool last) { return draw_once(options, values, last); });
}

}  // namespace

Subcommand render_subcommand() {
    return {
        .name = "render",
        .arguments = "PROGRAM [LOG] -o map.png",
        .summary = "draws the CL surface, coloured by speed, acceleration and more",
        .description =
            "Maps each logged point to its line, rebuilds the cutter-location surface from adjacent passes,\n"
            "colours it by a field and draws it without a display. Without a log the program is simulated on\n"
            "--machine, or drawn as it is programmed: by programmed_feed, block_length, turning_angle,\n"
            "programmed_curvature or, with a ball-end tool, scallop.\n"
            "A log that is too large for memory is drawn shard by shard, with --survey (docs/howto/shards.md).\n\n"
            "  clsurf render part.nc -o map.png\n"
            "  clsurf render part.nc -o blocks.png --color block_length --passes 3..8\n"
            "  clsurf render part.nc -o scallop.png --color scallop --tool ball:6\n"
            "  clsurf render part.nc run.biip -o map.png\n"
            "  clsurf render part.nc run.biip -o map.png --color acceleration --view top --range 0,800\n"
            "  clsurf render part.nc run.biip -o map.png --surface formed --tool ball:6",
        .declare = declare_render_with_shards,
        .positional = {"PROGRAM", "LOG"},
        .run = run_render,
    };
}

}  // namespace clsurf::cli
