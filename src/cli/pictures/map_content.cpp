#include "cli/pictures/map_content.h"

#include <utility>

#include <fmt/format.h>

#include "cli/pictures/defect_map.h"
#include "core/error.h"
#include "core/file_name.h"
#include "field/pass_ramps.h"
#include "program/frame_placement.h"
#include "viz/map_texts.h"

namespace clsurf::cli {

bool is_speed(const FieldInfo& field) { return field.preference == FieldPreference::higher && !has_classes(field); }

std::string run_name(const Shown& shown, const RenderOptions& options) {
    switch (shown.origin) {
        case PointOrigin::log: return file_name(options.part.log);
        case PointOrigin::simulation:
            return shown.part.machine ? "simulated on \"" + shown.part.machine->name + "\""
                                      : "simulated on the default machine";
        case PointOrigin::program: return "as programmed";
    }
    return {};
}

viz::MapPanel panel_of(const Shown& shown, const RenderOptions& options, std::string caption) {
    viz::MapPanel panel;
    panel.surface = &shown.surface;
    panel.field = &shown.field;
    panel.caption = std::move(caption);
    panel.outlines = shown.defects.outlines;
    panel.programmed = &shown.programmed;
    panel.place_of = [&shown](PointIndex i) { return shown.place_of(i); };
    if (has_classes(shown.field.info)) panel.classes = &shown.classes;
    if (shown.height_map)
        panel.height_map = &*shown.height_map;
    else if (is_speed(shown.field.info))
        panel.pale = pass_ramps(shown.field, shown.surface.passes, shown.part.log.period);
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

viz::MapTexts texts_of(const Shown& shown, const std::optional<Shown>& before, const RenderOptions& options,
                       const std::vector<std::string>& range_notes) {
    viz::MapTexts texts;
    texts.frame = common_work_system(shown.part.program.motions);
    const std::string_view positions =
        shown.origin == PointOrigin::program ? "programmed" : name_of(shown.part.path.role);
    texts.title = fmt::format(
        "{}, {} {}", shown.field.info.label, positions,
        options.shown.look.style == viz::Style::surface && shown.surface.step_over > 0 ? "surface" : "path");
    if (shown.height_map) texts.title = fmt::format("{}, {}", shown.field.info.label, to_text(*shown.part.tool));
    const std::string program = file_name(options.part.program);
    // The captions of two panels name the logs.
    const std::string counts =
        options.selection.is_all() ? viz::counts_of(shown.surface) : viz::counts_of_selection(shown.surface);
    texts.subtitle = before
                         ? fmt::format("{} · before: {} · after: {}", program, viz::counts_of(before->surface), counts)
                         : fmt::format("{} · {} · {}", program, run_name(shown, options), counts);
    if (!options.selection.is_all()) texts.notes.push_back("only " + options.selection.words);
    if (!shown.field.info.note.empty()) texts.notes.push_back(shown.field.info.note);
    if (!shown.height_map && is_speed(shown.field.info)) texts.notes.emplace_back(viz::ramps_note);
    if (options.programmed) texts.notes.emplace_back("thin lines: the programmed path");
    if (options.defects)
        texts.notes.push_back(shown.defects.outlines.empty()
                                  ? "no defects"
                                  : fmt::format("{} defects, 1 the worst", shown.defects.outlines.size()));
    if (options.defects) note_judgement(shown.defects.report, "", texts.notes);
    if (options.defects && before) note_judgement(before->defects.report, "before: ", texts.notes);
    texts.notes.insert(texts.notes.end(), range_notes.begin(), range_notes.end());
    const bool logged_tips = !shown.height_map && shown.origin == PointOrigin::log;
    if (logged_tips && shown.part.tool && options.shown.look.scales) texts.notes.emplace_back(viz::tool_tip_note);
    return texts;
}

viz::Image draw_defect_map(const Shown& shown, const RenderOptions& options) {
    const viz::DefectMap defects = defect_map_of(shown.defects.report);
    viz::MapPanel panel = panel_of(shown, options, "");
    panel.outlines.clear();
    panel.defects = &defects;
    viz::MapTexts texts = defect_map_texts(shown.defects.report, shown.part,
                                           fmt::format("{} · {} · {}", file_name(options.part.program),
                                                       run_name(shown, options), viz::counts_of(shown.surface)));
    if (options.programmed) texts.notes.emplace_back("thin lines: the programmed path");
    // Without defects the column of names would be empty.
    viz::Look look = options.shown.look;
    look.names = !defects.marks.empty();
    return viz::draw_map({panel}, viz::placed_map({panel}, look), {}, texts, look);
}

}  // namespace clsurf::cli
