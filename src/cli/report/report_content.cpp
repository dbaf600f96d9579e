#include "cli/report/report_content.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <system_error>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "cli/pictures/measured_picture.h"
#include "cli/pictures/programmed_lines.h"
#include "cli/report/report_pictures.h"
#include "cli/runs/measured_check.h"
#include "field/field_set.h"
#include "io/reports/simulation_origin.h"
#include "log/health.h"
#include "pipeline/contacts.h"
#include "pipeline/signals_of.h"
#include "pipeline/speed_reasons.h"
#include "predictor/outline.h"
#include "viz/field_colours.h"

namespace clsurf::cli {
namespace {

constexpr std::size_t pictured_defects = 6;
constexpr int height_map_pixels = 700;  ///< width of the as-machined surface on the page

std::vector<ShownRange> ranges_of(const std::vector<ReportLog>& logs) {
    std::vector<ShownRange> ranges;
    for (std::size_t k = 0; k < logs.front().fields.size(); ++k) {
        const auto range_in = [&](const ReportLog& log) {
            return find_range(log.fields[k], log.surface, {}, {}, log.quality.report.sections());
        };
        ShownRange range = range_in(logs.front());
        for (std::size_t other = 1; other < logs.size(); ++other) range = wider(range, range_in(logs[other]));
        ranges.push_back(std::move(range));
    }
    return ranges;
}

/// "2026-11-24 09:30 UTC"; empty: the log is not a file.
std::string date_of_file(const std::string& name) {
    std::error_code none;
    const auto written = std::filesystem::last_write_time(name, none);
    if (none) return {};
    const auto time = std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::file_clock::to_sys(written));
    return fmt::format("{:%Y-%m-%d %H:%M} UTC", time);
}

/// The name of the field that is shown first. `wanted`: its name or an alias; empty: the first field.
std::string first_field(const std::vector<Field>& fields, const std::string& wanted) {
    if (wanted.empty()) return fields.front().info.name;
    for (const Field& field : fields) {
        if (field.info.name == wanted) return wanted;
    }
    std::vector<FieldInfo> infos;
    for (const Field& field : fields) {
        if (std::find(field.info.also.begin(), field.info.also.end(), wanted) != field.info.also.end())
            return field.info.name;
        infos.push_back(field.info);
    }
    unknown_field(wanted, infos);
}

}  // namespace

ReportedForm form_for_report(const ReportLog& shown, const ReportOptions& options, StageClock& clock) {
    clock.begin("sweep the tool");
    const AsMachinedPart as_machined(shown.part, shown.surface, options.measured, *shown.part.tool,
                                     &shown.quality.report);
    viz::MapPanel panel;
    panel.surface = &shown.surface;
    viz::Look look;
    look.width = height_map_pixels;
    look.height = height_map_pixels;
    look.view = viz::parse_view("top");
    look.legend = false;
    ReportedForm made;
    made.map = make_as_machined_map(as_machined, {}, viz::placed_map({panel}, look).camera);
    made.range = find_range(made.map.field, as_one_pass(static_cast<PointIndex>(made.map.field.values.size())), {});
    return made;
}

void add_report_pictures(io::ReportPage& page, const ReportLog& shown, const ReportOptions& options,
                         const std::optional<ReportedForm>& as_machined) {
    PicturedPart pictured{&shown.part, &shown.surface, shown.fields,  page.ranges, shown.ramps, &shown.quality.report,
                          {},          options.gl,     options.shards};
    std::optional<PartContacts> contacts;
    if (as_machined && shown.part.tool) contacts.emplace(shown.part, shown.surface, *shown.part.tool);
    for (std::size_t i = 0; i < shown.quality.report.defects.size(); ++i) {
        const Defect& defect = shown.quality.report.defects[i];
        page.defects.push_back({outlines_of(defect, shown.surface), {}});
        if (contacts)
            page.defects.back().contact_outlines =
                outlines_of(defect, shown.surface, [&](PointIndex point) { return contacts->place(point).position(); });
        pictured.outlines.push_back({page.defects.back().outlines, fmt::format("{}", i + 1)});
    }
    if (!page.defects.empty()) page.pictures.push_back(picture_of_defects(pictured));
    page.pictures.push_back(picture_of_part(pictured, page.first_field));
    if (as_machined)
        page.pictures.push_back(
            picture_of_height_map(pictured, as_machined->map.height_map, as_machined->map.field, as_machined->range));
    if (page.defects.empty()) return;
    const PartSignals read = signals_of(shown.part, shown.surface, options.measured);
    for (std::size_t i = 0; i < page.defects.size(); ++i) {
        const Eigen::Vector3f normal = read.signals.normal(shown.quality.report.defects[i].point);
        if (normal.allFinite()) page.defects[i].normal = normal.cast<double>();
    }
    for (std::size_t i = 0; i < std::min(pictured_defects, page.defects.size()); ++i) {
        page.defects[i].picture = picture_of_defect(pictured, read.signals, i);
        const Defect& defect = shown.quality.report.defects[i];
        if (!(defect.speed_mismatch < 0)) continue;
        const double speed = speeds_of(shown)[static_cast<std::size_t>(defect.point)];
        page.defects[i].slow = words_of(speed_reasons(shown.part, defect.point, speed), speed);
    }
}

io::PageMeasured measured_for_report(const ReportLog& shown, const ReportOptions& options, StageClock& clock) {
    io::PageMeasured measured{compare_measured(shown.part, shown.surface, shown.quality.report, options.measured,
                                               *options.measurement, clock),
                              {}};
    if (!measured.measurement.result.comparison.reason.empty()) return measured;
    const MeasuredPicture picture = draw_measured(measured.measurement, shown.part, *shown.part.tool);
    measured.picture = {"Measured profile",
                        "Over its form, its roughness over the predicted one, and their difference.",
                        viz::encode_image(picture.image, picture.title, "png")};
    return measured;
}

io::PageHeightMap page_height_map_of(const ReportedForm& as_machined) {
    const viz::HeightMap& map = as_machined.map.height_map;
    return {map.origin,
            map.pitch,
            map.columns,
            map.rows,
            map.z,
            as_machined.map.field.values,
            as_machined.range,
            as_machined.map.field.info.note};
}

std::optional<io::PageProgrammed> programmed_path(const ReportLog& shown, const ReportOptions& options) {
    constexpr PointIndex most_corners = 200'000;  // some points of a long program are left out: its lines are thin
    if (!why_no_programmed_lines(options.part, shown.part).empty()) return std::nullopt;
    io::PageProgrammed programmed;
    for (const std::vector<Vec3>& line : programmed_lines(options.part, most_corners)) {
        for (std::size_t k = 0; k < line.size(); ++k) {
            programmed.corners.push_back(line[k]);
            programmed.begin.push_back(k > 0 ? 0 : 1);
        }
    }
    if (programmed.corners.empty()) return std::nullopt;
    return programmed;
}

io::ReportPage report_page_of(const ReportLog& shown, const std::vector<ReportLog>& logs,
                              const ReportOptions& options) {
    io::ReportPage page;
    page.program = options.part.program;
    page.log = options.part.log;
    page.before = options.before;
    page.log_date = date_of_file(options.part.log);
    page.reading_options = options.reading_options;
    page.most_bytes = options.most_bytes;
    page.ranges = ranges_of(logs);
    page.first_field = first_field(shown.fields, options.first_field);
    page.quality.report = &shown.quality.report;
    page.quality.program = &shown.part.program;
    page.quality.log = shown.part.log.name;
    page.quality.tool = shown.part.tool;
    page.quality.origin = io::simulation_origin(shown.part.log);
    page.quality.scallop = shown.quality.scallop;
    page.quality.as_machined = shown.quality.as_machined ? &*shown.quality.as_machined : nullptr;
    page.quality.acceptance = shown.acceptance ? &*shown.acceptance : nullptr;
    page.health = shown.part.diagnostics;
    page.health.append(check_health(shown.part.log, shown.part.program.main().line_count()));
    for (const Field& field : shown.fields) {
        if (!field.info.percentiles) continue;
        page.percentiles.push_back(
            {field.info.name, percentiles_of_size(field, shown.surface.passes, io::page_percentiles)});
    }
    if (logs.size() > 1) {
        const ReportLog& before = logs.back();
        page.change.emplace();
        page.change->before = &before.quality.report;
        page.change->match =
            match_defects({&before.quality.report.defects, &before.surface.positions, before.surface.step_over},
                          {&shown.quality.report.defects, &shown.surface.positions, shown.surface.step_over});
        page.change->roughness = roughness_change(before.part, before.surface, shown.part, shown.surface,
                                                  options.measured, &before.quality.report);
    }
    page.colour_maps = page_colour_maps();
    for (const Field& field : shown.fields) page.field_maps.push_back(viz::usual_colour_map_name(field.info));
    return page;
}

}  // namespace clsurf::cli
