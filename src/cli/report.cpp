// clsurf report: the linked page.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/fields.h"
#include "cli/formed.h"
#include "cli/output_format.h"
#include "cli/report_log.h"
#include "cli/report_pictures.h"
#include "io/atomic_file.h"
#include "log/health.h"
#include "pipeline/contacts.h"
#include "quality/outline.h"
#include "viz/image_library.h"

namespace clsurf::cli {
namespace {

constexpr std::size_t pictured_defects = 6;
constexpr int relief_pixels = 700;  ///< of the formed surface across the page

struct ReportOptions {
    PartOptions part;
    std::optional<Role> measured;
    std::string before, output, gl;
    std::vector<std::string> fields;  ///< empty: the usual ones
    std::string first_field;
    std::uint64_t most_bytes = 0;
    std::vector<std::string> reading_options;
};

void declare_report(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("output,o", po::value<std::string>()->value_name("FILE"), "the page (HTML)")
        ("before", po::value<std::string>()->value_name("LOG"), "another log of the program, shown on the same scale")
        ("fields", po::value<std::string>()->value_name("FIELD,…"), "what can be coloured and plotted (default: motion, errors, differences to the passes beside, the log's own channels)")
        ("color", po::value<std::string>()->value_name("FIELD"), "what is coloured at first (default: the first of the fields)")
        ("max-size", po::value<double>()->value_name("MB"), "most that the file may have; points are left out where it needs more (default: 30)")
        ("gl", po::value<std::string>()->value_name("osmesa|egl"), "what draws the pictures: the processor, or a graphics card (default: osmesa)");
    // clang-format on
    declare_tool(options);
    declare_part(options);
}

/// What `render` needs to read the same, as words of a command line. Which positions are shown the page itself knows.
std::vector<std::string> reading_options_of(const po::variables_map& values) {
    po::options_description reading;
    declare_part(reading);
    return words_of(reading, values, {"surface"});
}

ReportOptions read_report_options(const po::variables_map& values) {
    ReportOptions options;
    options.part = read_part_options(values);
    options.measured = take_measured_role(options.part);
    options.output = required(values, "output");
    if (values.count("before") > 0) options.before = values["before"].as<std::string>();
    options.gl = values.count("gl") > 0 ? values["gl"].as<std::string>() : "osmesa";
    if (values.count("fields") > 0) {
        options.fields = split_names(values["fields"].as<std::string>());
        if (options.fields.empty() || options.fields.size() > 32)
            throw UsageError("--fields: 1 to 32 names separated by commas");
    }
    if (values.count("color") > 0) options.first_field = values["color"].as<std::string>();
    const double megabytes = values.count("max-size") > 0 ? values["max-size"].as<double>() : 30.0;
    if (!(megabytes >= 2 && megabytes <= 2000)) throw UsageError("--max-size must be 2 … 2000 MB");
    options.most_bytes = static_cast<std::uint64_t>(megabytes * 1e6);
    options.reading_options = reading_options_of(values);
    return options;
}

/// The fields that a log has values for.
std::vector<std::string> usual_fields(const Log& log) {
    std::vector<std::string> names{"speed", "acceleration", "tangential_acceleration", "jerk"};
    if (log.has(Role::commanded) && (log.has(Role::feedback) || log.has(Role::actual)))
        names.insert(names.end(), {"following_error", "contour_error"});
    names.insert(names.end(), {"speed_mismatch", "acceleration_mismatch", "height"});
    constexpr std::size_t most = 16;
    for (const Channel& channel : log.channels) {
        const bool position =
            channel.name.starts_with("cmd.") || channel.name.starts_with("fb.") || channel.name.starts_with("act.");
        const bool known = std::find(names.begin(), names.end(), channel.name) != names.end();
        if (!position && !known && channel.name != "time" && channel.name != "line" && channel.name != "program" &&
            names.size() < most)
            names.push_back(channel.name);
    }
    return names;
}

bool has_values(const Field& field, const Passes& passes) {
    for (const Pass& pass : passes) {
        if (pass.kind != PassKind::cut) continue;
        for (PointIndex i = pass.first; i <= pass.last; ++i) {
            if (std::isfinite(field.values[static_cast<std::size_t>(i)])) return true;
        }
    }
    return false;
}

ReportLog prepare(const PartOptions& part_options, const ReportOptions& options, StageClock& clock) {
    ReportLog shown;
    shown.part = load_part(part_options, clock);
    clock.begin("stitch the surface");
    shown.surface = stitch(shown.part);
    shown.quality = judge(shown.part, shown.surface, options.measured, {}, clock.stages());
    shown.part.diagnostics.append(shown.quality.diagnostics);
    clock.begin("compute the fields");
    Fields fields(shown.part, shown.surface);
    const bool usual = options.fields.empty();
    for (const std::string& name : usual ? usual_fields(shown.part.log) : options.fields) {
        Field field = fields.get(name);
        // What was asked for by name must be there; of the usual ones a log has some.
        if (!usual || has_values(field, shown.surface.passes)) shown.fields.push_back(std::move(field));
    }
    shown.other_roles = other_roles(shown.part);
    clock.end();
    return shown;
}

/// Only fields that both logs have can be compared.
void keep_common_fields(std::vector<Field>& fields, const std::vector<Field>& other) {
    std::erase_if(fields, [&](const Field& field) {
        return std::none_of(other.begin(), other.end(), [&](const Field& f) { return f.info.name == field.info.name; });
    });
}

std::vector<ShownRange> ranges_of(const std::vector<ReportLog>& logs) {
    std::vector<ShownRange> ranges;
    for (std::size_t k = 0; k < logs.front().fields.size(); ++k) {
        ShownRange range = find_range(logs.front().fields[k], logs.front().surface.passes, {});
        for (std::size_t other = 1; other < logs.size(); ++other) {
            range = wider(range, find_range(logs[other].fields[k], logs[other].surface.passes, {}));
        }
        ranges.push_back(std::move(range));
    }
    return ranges;
}

/// The formed surface as a height map that a page can carry.
struct Formed {
    FormedMap map;
    ShownRange range;
};

Formed form(const ReportLog& shown, const ReportOptions& options, StageClock& clock) {
    clock.begin("sweep the tool");
    const FormedPart formed(shown.part, shown.surface, options.measured, *shown.part.tool);
    viz::MapPanel panel;
    panel.surface = &shown.surface;
    viz::Look look;
    look.width = relief_pixels;
    look.height = relief_pixels;
    look.view = viz::parse_view("top");
    look.legend = false;
    Formed made;
    made.map = make_formed_map(formed, {}, viz::map_camera({panel}, look));
    made.range = find_range(made.map.field, all_as_one_cut(static_cast<PointIndex>(made.map.field.values.size())), {});
    return made;
}

void add_pictures(io::ReportPage& page, const ReportLog& shown, const ReportOptions& options,
                  const std::optional<Formed>& formed) {
    PicturedPart pictured{&shown.part, &shown.surface, shown.fields, page.ranges, &shown.quality.report,
                          {},          options.gl};
    std::optional<PartContacts> contacts;
    if (formed && shown.part.tool) contacts.emplace(shown.part, shown.surface, *shown.part.tool);
    for (std::size_t i = 0; i < shown.quality.report.defects.size(); ++i) {
        const Defect& defect = shown.quality.report.defects[i];
        page.defects.push_back({outlines_of(defect, shown.surface), {}});
        if (contacts)
            page.defects.back().contact_outlines =
                outlines_of(defect, shown.surface, [&](PointIndex point) { return contacts->place(point).position(); });
        pictured.outlines.push_back({page.defects.back().outlines, fmt::format("{}", i + 1)});
    }
    page.pictures.push_back(picture_of_part(pictured, page.first_field));
    if (formed)
        page.pictures.push_back(picture_of_relief(pictured, formed->map.relief, formed->map.field, formed->range));
    for (std::size_t i = 0; i < std::min(pictured_defects, page.defects.size()); ++i)
        page.defects[i].picture = picture_of_defect(pictured, i);
}

io::PageRelief page_relief(const Formed& formed) {
    const viz::Relief& r = formed.map.relief;
    return {
        r.origin, r.pitch, r.columns, r.rows, r.z, formed.map.field.values, formed.range, formed.map.field.info.note};
}

/// The page without its pictures and the machined surface.
io::ReportPage page_of(const ReportLog& shown, const std::vector<ReportLog>& logs, const ReportOptions& options) {
    io::ReportPage page;
    page.program = options.part.program;
    page.log = options.part.log;
    page.before = options.before;
    page.reading_options = options.reading_options;
    page.most_bytes = options.most_bytes;
    page.ranges = ranges_of(logs);
    page.first_field = options.first_field.empty() ? shown.fields.front().info.name
                                                   : std::string(usual_name(options.first_field, shown.part.log));
    if (std::none_of(shown.fields.begin(), shown.fields.end(),
                     [&](const Field& f) { return f.info.name == page.first_field; })) {
        std::vector<FieldInfo> infos;
        for (const Field& field : shown.fields) infos.push_back(field.info);
        unknown_field(page.first_field, infos);
    }
    page.quality.report = &shown.quality.report;
    page.quality.program = &shown.part.program;
    page.quality.log = shown.part.log.name;
    page.quality.tool = shown.part.tool;
    page.quality.scallop = shown.quality.scallop;
    page.quality.formed = shown.quality.formed ? &*shown.quality.formed : nullptr;
    page.health = shown.part.diagnostics;
    page.health.append(check_health(shown.part.log, shown.part.program.main().line_count()));
    for (const Field& field : shown.fields) {
        if (field.info.name.find("mismatch") == std::string::npos && field.info.name != "height" &&
            field.info.name != "contour_error")
            continue;
        page.percentiles.push_back(
            {field.info.name, percentiles_of_size(field, shown.surface.passes, io::page_percentiles)});
    }
    page.colour_maps = page_colour_maps();
    return page;
}

ExitCode run_report(const po::variables_map& values) {
    const ReportOptions options = read_report_options(values);
    (void)output_format(options.output, page_formats());
    io::AtomicFile output(options.output);  // a name that cannot be written fails before the work
    const viz::ImageLibraryPreload preload;
    StageClock clock(read_common(values), options.before.empty() ? 12 : 20);
    std::vector<ReportLog> logs;
    logs.push_back(prepare(options.part, options, clock));
    print(logs.front().part.diagnostics, values);
    if (!options.before.empty()) {
        PartOptions other = options.part;
        other.log = options.before;
        logs.push_back(prepare(other, options, clock));
        print(logs.back().part.diagnostics, values);
        keep_common_fields(logs.front().fields, logs.back().fields);
        keep_common_fields(logs.back().fields, logs.front().fields);
    }
    const ReportLog& shown = logs.front();
    if (shown.fields.empty())
        throw InputError(Place::of_file(shown.part.log.name), "no cutting point has a value to show",
                         "too few points, or the program and the log do not belong together?");

    clock.begin("measure");
    io::ReportPage page = page_of(shown, logs, options);
    std::optional<Formed> formed;
    if (shown.part.tool && shown.surface.step_over > 0) {
        formed = form(shown, options, clock);
        page.relief = page_relief(*formed);
        page.formed_options = {"--surface", "formed", "--tool", to_text(*shown.part.tool)};
        if (options.measured)
            page.formed_options.insert(page.formed_options.end(), {"--swept", std::string(name_of(*options.measured))});
    }
    clock.begin("draw");
    add_pictures(page, shown, options, formed);
    clock.begin("write the page");
    output.write(fit_page(page, logs));
    output.commit();
    return ExitCode::done;
}

}  // namespace

Subcommand report_subcommand() {
    return {
        .name = "report",
        .arguments = "PROGRAM LOG -o report.html",
        .summary = "the linked page: surface, program, curves and defects in one HTML file",
        .description =
            "Writes one file that any browser opens offline: the surface to turn, each place linked with its\n"
            "line and its point on the curves, the defects with pictures, the health of the log. Nothing in it\n"
            "asks a server for anything. Pictures, tables and summary can be read without JavaScript.\n\n"
            "  clsurf report part.nc run.biip -o report.html\n"
            "  clsurf report part.nc run.biip -o report.html --tool ball:6 --before old.biip",
        .declare = declare_report,
        .positional = {"PROGRAM", "LOG"},
        .run = run_report,
    };
}

}  // namespace clsurf::cli
