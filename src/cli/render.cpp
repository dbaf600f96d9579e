// clsurf render: the quality map.

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "cli/fields.h"
#include "cli/formed.h"
#include "cli/look.h"
#include "cli/part.h"
#include "cli/picture_output.h"
#include "cli/stage_clock.h"
#include "core/file_name.h"
#include "core/spelling.h"
#include "field/range.h"
#include "pipeline/contacts.h"
#include "pipeline/judge.h"
#include "quality/outline.h"
#include "viz/scene.h"

namespace clsurf::cli {
namespace {

struct RenderOptions {
    PartOptions part;
    std::string before;  ///< log of the other panel; empty: one panel
    std::string output;
    std::string field = "speed";
    LookOptions shown;
    std::vector<PointIndex> points;
    std::vector<LineNumber> lines;
    bool defects = false;
    std::optional<Role> swept;  ///< its positions; none: the most truthful
};

void declare_render(po::options_description& options) {
    declare_part(options, true);
    declare_derivative(options);
    declare_tool(options);
    // clang-format off
    options.add_options()
        ("swept", po::value<std::string>()->value_name("commanded|feedback|actual"), "positions that the formed surface's tool runs along (default: actual, else feedback, else commanded)")
        ("output,o", po::value<std::string>()->value_name("FILE"), "the picture: .png, .jpg, .tif or .webp")
        ("color", po::value<std::string>()->value_name("FIELD"), "what is coloured (default: speed; `clsurf help fields`)")
        ("mark-point", po::value<std::vector<long long>>()->value_name("N"), "ring a point; may be repeated")
        ("mark-line", po::value<std::vector<long long>>()->value_name("N"), "draw the points of a line bold; may be repeated")
        ("defects", "outline and number what `clsurf check` finds")
        ("before", po::value<std::string>()->value_name("LOG"), "another log of the program, drawn beside it on the same scale");
    // clang-format on
    declare_look(options);
}

void read_formed(const po::variables_map& values, RenderOptions& options) {
    if (!options.part.formed) {
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

RenderOptions read_render_options(const po::variables_map& values) {
    RenderOptions options;
    options.part = read_part_options(values);
    options.output = required(values, "output");
    options.before = text_of(values, "before", "");
    options.field = text_of(values, "color", "speed");
    options.shown = read_look_options(values);
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
    read_formed(values, options);
    return options;
}

/// A part with its surface and its field.
struct Shown {
    Part part;
    ClSurface surface;
    Field field;
    std::optional<viz::Relief> relief;  ///< the formed surface, whose vertices have the field then
    std::vector<viz::OutlineMark> defects;
    std::unique_ptr<const PartContacts> contacts;  ///< of the formed surface; `this` does not move any more

    /// Where a point is marked in the picture [mm].
    [[nodiscard]] Vec3 place_of(PointIndex i) const {
        return contacts ? contacts->place(i).position() : surface.positions.absolute(i);
    }
};

/// The formed surface in place of the positions', as fine as the picture shows it.
void form(Shown& shown, const RenderOptions& options, StageClock& clock) {
    viz::MapPanel panel;
    panel.surface = &shown.surface;
    const viz::Camera camera = viz::map_camera({panel}, options.shown.look);
    const CuttingTool tool = required_tool(shown.part, "--surface formed", "--surface formed --tool ball:6");
    clock.begin("sweep the tool");
    const FormedPart formed(shown.part, shown.surface, options.swept, tool);
    FormedMap map = make_formed_map(formed, options.shown.look.box, camera);
    clock.end();
    shown.field = std::move(map.field);
    shown.relief = std::move(map.relief);
    shown.contacts = std::make_unique<const PartContacts>(shown.part, shown.surface, tool);
}

/// What `check` finds, as outlines: passes are compared where they were commanded, heights measured
/// from the positions that are shown. With `tool` they are drawn where it touches the part. Adds why nothing was judged
/// to the part's diagnostics.
std::vector<viz::OutlineMark> outline_defects(Part& part, const ClSurface& surface,
                                              const std::optional<CuttingTool>& tool, StageClock& clock) {
    std::vector<viz::OutlineMark> outlines;
    const auto add = [&](const Trajectory& path, const ClSurface& judged, std::optional<Role> measured) {
        clock.begin("derive the signals");
        const PartSignals read = signals_along(part.log, path, judged, measured);
        clock.begin("find the defects");
        const QualityReport report = find_defects(part, path, judged, read);
        note_reasons(report, part, part.diagnostics);
        std::optional<PartContacts> contacts;
        if (tool) contacts.emplace(part.log, path, *part.lines, judged, *tool);
        const auto place_of = [&](PointIndex i) {
            return contacts ? contacts->place(i).position() : judged.positions.absolute(i);
        };
        for (std::size_t i = 0; i < report.defects.size(); ++i)
            outlines.push_back({outlines_of(report.defects[i], judged, place_of), fmt::format("{}", i + 1)});
    };
    if (part.path.role == Role::commanded || !part.log.has(Role::commanded)) {
        add(part.path, surface, std::nullopt);
        return outlines;
    }
    const Trajectory commanded = reconstruct_like(part.log, Role::commanded, part.path);
    add(commanded, stitch(gather(commanded), *part.lines), part.path.role);
    return outlines;
}

Shown prepare(const PartOptions& options, const std::string& field, bool defects, StageClock& clock) {
    Shown shown;
    shown.part = load_part(options, clock);
    clock.begin("stitch the surface");
    shown.surface = stitch(shown.part);
    clock.begin("compute the field");
    if (!options.formed) shown.field = Fields(shown.part, shown.surface).get(field);
    if (defects)
        shown.defects = outline_defects(shown.part, shown.surface,
                                        options.formed ? shown.part.tool : std::optional<CuttingTool>(), clock);
    clock.end();
    return shown;
}

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

/// The range of what lies in the picture.
ShownRange range_of(const Shown& shown, const RenderOptions& options, const viz::Camera& camera) {
    const viz::Zoom& zoom = options.shown.look.zoom;
    const bool whole = zoom.x0 <= 0 && zoom.y0 <= 0 && zoom.x1 >= 1 && zoom.y1 >= 1 && options.shown.look.box.isEmpty();
    const auto in_picture = [&](PointIndex i) {
        return viz::shows(camera, options.shown.look,
                          shown.relief ? shown.relief->at(i) : shown.surface.positions.absolute(i));
    };
    const ShownPoints points = whole ? ShownPoints() : ShownPoints(in_picture);
    if (!shown.relief) return find_range(shown.field, shown.surface.passes, options.shown.range, points);
    return find_range(shown.field, all_as_one_cut(static_cast<PointIndex>(shown.field.values.size())),
                      options.shown.range, points);
}

/// A mark that the picture cannot show is said on stderr, since its lack may not be noticed.
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

ExitCode run_render(const po::variables_map& values) {
    const RenderOptions options = read_render_options(values);
    PictureOutput output(options.output);
    const int stages_of_a_part = options.defects ? 7 : 5;
    StageClock clock(read_common(values), stages_of_a_part * (options.before.empty() ? 1 : 2) + 3);
    Shown after = prepare(options.part, options.field, options.defects, clock);
    if (options.part.formed) form(after, options, clock);
    print(after.part.diagnostics, values);
    std::vector<viz::MapPanel> panels;
    std::optional<Shown> before;
    if (!options.before.empty()) {
        PartOptions other = options.part;
        other.log = options.before;
        before = prepare(other, options.field, options.defects, clock);
        if (other.formed) form(*before, options, clock);
        print(before->part.diagnostics, values);
        panels.push_back(panel_of(*before, options, "before: " + file_name(options.before)));
    }
    panels.push_back(panel_of(after, options, before ? "after: " + file_name(options.part.log) : ""));

    clock.begin("choose the range");
    const viz::Camera camera = viz::map_camera(panels, options.shown.look);
    warn_of_marks_outside(after, options, camera, values);
    ShownRange range = range_of(after, options, camera);
    if (before) {
        const std::string note = range.note;
        range = wider(range, range_of(*before, options, camera));
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
            "Maps each logged point to its line, puts the cutter-location surface back together from\n"
            "neighbouring passes, colours it by a field and draws it without a display.\n\n"
            "  clsurf render part.nc run.biip -o map.png\n"
            "  clsurf render part.nc run.biip -o map.png --color acceleration --view top --range 0,800\n"
            "  clsurf render part.nc run.biip -o map.png --surface formed --tool ball:6",
        .declare = declare_render,
        .positional = {"PROGRAM", "LOG"},
        .run = run_render,
    };
}

}  // namespace clsurf::cli
