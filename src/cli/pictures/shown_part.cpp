#include "cli/pictures/shown_part.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "cli/pictures/as_machined.h"
#include "cli/pictures/programmed_lines.h"
#include "core/error.h"
#include "io/readers/program_file.h"
#include "pipeline/judge.h"
#include "pipeline/part_fields.h"
#include "pipeline/program_fields.h"
#include "pipeline/programmed_part.h"
#include "pipeline/scallop_fields.h"
#include "predictor/outline.h"
#include "surface/selection.h"
#include "surface/stitch.h"

namespace clsurf::cli {
namespace {

/// The findings of `check`, with outlines: passes are compared at their commanded positions, heights measured
/// from the shown positions. With `tool`, outlines are drawn at the contact points. If nothing was judged, the reasons
/// are added to the part's diagnostics.
ShownDefects find_shown_defects(Part& part, const ClSurface& surface, const std::optional<CuttingTool>& tool,
                                StageClock& clock) {
    ShownDefects shown;
    const auto add = [&](const Trajectory& path, const ClSurface& judged, std::optional<Role> measured) {
        clock.begin("derive the signals");
        const PartSignals read = signals_along(part.log, path, judged, measured);
        clock.begin("find the defects");
        shown.report = find_defects(part, path, judged, read);
        note_reasons(shown.report, part, part.diagnostics);
        std::optional<PartContacts> contacts;
        if (tool) contacts.emplace(part.log, path, *part.lines, judged, *tool);
        const auto place_of = [&](PointIndex i) {
            return contacts ? contacts->place(i).position() : judged.positions.absolute(i);
        };
        for (std::size_t i = 0; i < shown.report.defects.size(); ++i)
            shown.outlines.push_back(
                {outlines_of(shown.report.defects[i], judged, place_of), fmt::format("{}", i + 1)});
    };
    if (part.path.role == Role::commanded || !part.log.has(Role::commanded)) {
        add(part.path, surface, std::nullopt);
        return shown;
    }
    const Trajectory commanded = reconstruct_like(part.log, Role::commanded, part.path);
    add(commanded, stitch(gather(commanded), *part.lines), part.path.role);
    return shown;
}

/// The program with its motions as programmed.
Program read_programmed(const PartOptions& options, bool placed) {
    io::ProgramOptions how = options.program_options;
    how.coordinates = placed ? std::optional(Coordinates::workpiece) : std::nullopt;
    return io::read_program(options.program, how);
}

Shown programmed(const PartOptions& options, const std::string& field, StageClock& clock) {
    if (options.poses.zero && !options.poses.zero_is_default)
        throw UsageError("--work-offset places a log; '" + field + "' is drawn in the coordinates of the program");
    Shown shown;
    shown.origin = PointOrigin::program;
    clock.begin("read the program");
    Program program = read_programmed(options, true);
    clock.begin("stitch the surface");
    ProgrammedPart made = programmed_part(std::move(program));
    shown.part = std::move(made.part);
    shown.surface = std::move(made.surface);
    if (shown.surface.positions.size() == 0)
        throw InputError(Place::of_file(options.program), "has no motions to show");
    show_all_cutting(shown.surface);
    clock.begin("compute the field");
    shown.part.tool = find_tool(options.tool, nullptr, &shown.part.program, shown.part.diagnostics);
    FieldSet fields(shown.part.log.records);
    fields.add(std::make_shared<const ProgramFields>(shown.part.program, shown.part.lines));
    fields.add(std::make_shared<const ScallopFields>(shown.surface, shown.part.tool));
    shown.field = fields.get(field);
    clock.end();
    return shown;
}

/// A part from a log, or from the simulation of a program without a log.
Part load_run_of(const PartOptions& options, StageClock& clock) {
    if (!options.log.empty()) return load_part(options, clock);
    clock.begin("read the program");
    Program program = read_programmed(options, false);
    clock.begin("simulate");
    SimulatedPart made = simulated_part(std::move(program), rules_of(options));
    Part part = std::move(made.part);
    part.diagnostics.append(made.summary.diagnostics);
    part.tool = find_tool(options.tool, &part.log, &part.program, part.diagnostics);
    clock.end();
    return part;
}

}  // namespace

Shown load_shown(const PartOptions& options, const std::string& field, bool defects, StageClock& clock) {
    const bool of_program = ProgramFields::has(field) || ScallopFields::has(field);
    if (options.log.empty() && of_program && !defects) return programmed(options, field, clock);
    Shown shown;
    shown.origin = options.log.empty() ? PointOrigin::simulation : PointOrigin::log;
    shown.part = load_run_of(options, clock);
    clock.begin("stitch the surface");
    shown.surface = stitch(shown.part);
    if (defects)
        shown.defects = find_shown_defects(shown.part, shown.surface,
                                           options.as_machined ? shown.part.tool : std::optional<CuttingTool>(), clock);
    clock.begin("compute the field");
    if (!options.as_machined) {
        show_all_cutting(shown.surface);
        const FieldSet fields = fields_of(shown.part, shown.surface);
        const std::string usual = fields.can_compute("feed_share") ? "feed_share" : "speed";
        shown.field = fields.get(field.empty() ? usual : field);
        if (has_classes(shown.field.info))
            shown.classes = viz::FieldClasses(shown.field.info, shown.field.values, shown.surface.passes);
    }
    clock.end();
    return shown;
}

void show_programmed(Shown& shown, const PartOptions& options) {
    constexpr PointIndex most_points = 2'000'000;  // longer programs are drawn with some points left out
    if (const std::string why = why_no_programmed_lines(options, shown.part); !why.empty())
        throw UsageError("--programmed: " + why);
    shown.programmed = programmed_lines(options, most_points);
}

void show_selection(Shown& shown, const Selection& selection) {
    if (selection.is_all()) return;
    const PointIndex last = shown.part.log.records - 1;
    std::vector<PointRange> ranges{{0, last}};
    if (selection.points)
        ranges = intersection(ranges, {{selection.points->first, std::min(last, selection.points->last)}});
    if (selection.lines) {
        constexpr std::int64_t most = no_line - 1;
        const auto line = [&](std::int64_t number) { return static_cast<LineNumber>(std::min(number, most)); };
        ranges = intersection(ranges,
                              shown.part.lines->points_of(line(selection.lines->first), line(selection.lines->last)));
    }
    if (selection.passes)
        ranges = intersection(ranges,
                              points_of_passes(shown.surface.passes, selection.passes->first, selection.passes->last));
    keep_points(shown.surface, ranges);
    const auto is_shown = [](const Pass& pass) { return is_of_surface(pass.kind); };
    if (std::none_of(shown.surface.passes.begin(), shown.surface.passes.end(), is_shown))
        throw UsageError("no finishing pass lies in " + selection.words);
}

void show_as_machined(Shown& shown, const RenderOptions& options, StageClock& clock) {
    viz::MapPanel panel;
    panel.surface = &shown.surface;
    const viz::Camera camera = viz::placed_map({panel}, options.shown.look).camera;
    const CuttingTool tool = required_tool(shown.part, "--surface formed", "--surface formed --tool ball:6");
    clock.begin("sweep the tool");
    const AsMachinedPart as_machined(shown.part, shown.surface, options.swept, tool);
    AsMachinedMap map = make_as_machined_map(as_machined, options.shown.look.box, camera);
    clock.end();
    shown.field = std::move(map.field);
    shown.height_map = std::move(map.height_map);
    shown.contacts = std::make_unique<const PartContacts>(shown.part, shown.surface, tool);
}

ShownRange range_in_picture(const Shown& shown, const RenderOptions& options, const viz::Camera& camera) {
    const viz::Zoom& zoom = options.shown.look.zoom;
    const bool whole = zoom.x0 <= 0 && zoom.y0 <= 0 && zoom.x1 >= 1 && zoom.y1 >= 1 && options.shown.look.box.isEmpty();
    const auto in_picture = [&](PointIndex i) {
        return viz::shows(camera, options.shown.look,
                          shown.height_map ? shown.height_map->at(i) : shown.surface.positions.absolute(i));
    };
    const ShownPoints points = whole ? ShownPoints() : ShownPoints(in_picture);
    if (!shown.height_map)
        return find_range(shown.field, shown.surface, options.shown.range, points, shown.defects.report.sections());
    return find_range(shown.field, as_one_pass(static_cast<PointIndex>(shown.field.values.size())), options.shown.range,
                      points);
}

void warn_of_marks_outside(const Shown& shown, const RenderOptions& options, const viz::Camera& camera,
                           const po::variables_map& values) {
    Diagnostics diagnostics;
    const auto outside = [&](PointIndex i) { return !viz::shows(camera, options.shown.look, shown.place_of(i)); };
    const auto warn = [&](const std::string& what) {
        diagnostics.add(
            {Severity::warning, "render.mark-outside", Place(), what + " lies outside the part that is shown", {}});
    };
    for (const PointIndex point : options.points) {
        if (outside(point)) warn(fmt::format("point {}", point));
    }
    for (const LineNumber line : options.lines) {
        bool seen = false;
        for (const PointRange& range : shown.part.lines->points_of(line)) {
            for (PointIndex i = range.first; i <= range.last && !seen; ++i) seen = !outside(i);
        }
        if (!seen) warn(fmt::format("line {}", line));
    }
    print(diagnostics, values);
}

}  // namespace clsurf::cli
