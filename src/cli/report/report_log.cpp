#include "cli/report/report_log.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "cli/pictures/map_content.h"
#include "core/error.h"
#include "field/pass_ramps.h"
#include "pipeline/part_fields.h"
#include "surface/stitch.h"
#include "viz/colour_map.h"

namespace clsurf::cli {
namespace {

constexpr std::size_t most_fields = 28;          ///< if none are named
constexpr double usual_bytes = 24;               ///< size of a point in the page, as a first estimate
constexpr std::uint64_t usual_rest = 3'000'000;  ///< [bytes] size of pictures, text and script

/// Chooses at most `most` points of a log for the page.
void choose_points(ReportLog& shown, PointIndex most) {
    shown.kept = keep_points(shown.surface, *shown.part.lines, shown.fields, shown.quality.report.defects, most);
    shown.vertices = viz::section_vertices(shown.surface, shown.kept.points);
    // All ends of passes are kept, so each point between two vertices is represented by the closer vertex, at any distance.
    shown.bands =
        viz::join_passes(shown.surface, shown.vertices, viz::NearnessFrame(), std::numeric_limits<float>::max());
    shown.slow = slow_words(shown.part, shown.kept.points, speeds_of(shown));
}

io::PageSurface page_surface(const ReportLog& shown) {
    io::PageSurface page;
    page.log = &shown.part.log;
    page.lines = shown.part.lines.get();
    page.surface = &shown.surface;
    page.path = &shown.part.path;
    page.other_roles = shown.other_roles;
    page.kept = &shown.kept;
    page.fields = shown.fields;
    page.classes = shown.classes;
    page.ramps = shown.ramps;
    page.joined = shown.vertices.joined;
    page.triangles = shown.bands.triangles;
    page.segments = shown.bands.segments;
    page.slow = &shown.slow;
    page.places_before = shown.places_before;
    return page;
}

void refuse_unknown_fields(const std::vector<std::string>& names, const FieldSet& fields) {
    for (const std::string& name : names) {
        if (!fields.has(name)) unknown_field(name, fields.fields());
    }
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

}  // namespace

std::span<const float> speeds_of(const ReportLog& shown) {
    for (const Field& field : shown.fields) {
        if (field.info.name == "speed") return field.values;
    }
    return shown.speed;
}

ReportLog load_report_log(const PartOptions& part_options, const ReportOptions& options, StageClock& clock) {
    ReportLog shown;
    shown.part = load_part(part_options, clock);
    std::optional<FieldSet> fields;  // made once: it estimates the motion of the log
    if (options.merged) {
        clock.begin("judge the shards");
        shown.quality = judge_merged(*options.merged, shown.part, options.measured, false, clock, shown.surface);
        fields = fields_of(shown.part, shown.surface);
    } else {
        clock.begin("stitch the surface");
        shown.surface = stitch(shown.part);
        fields = fields_of(shown.part, shown.surface);
        refuse_unknown_fields(options.fields, *fields);  // before the long computations
        shown.quality = judge(shown.part, shown.surface, options.measured, {}, clock.stages());
        show_all_cutting(shown.surface);
    }
    shown.part.diagnostics.append(shown.quality.diagnostics);
    clock.begin("compute the fields");
    const bool usual = options.fields.empty();
    for (Field& field : fields->get_all(usual ? fields->report_names(most_fields) : options.fields)) {
        // Fields requested by name must exist; of the default ones a log has some.
        if (!usual || has_values(field, shown.surface.passes)) shown.fields.push_back(std::move(field));
    }
    if (speeds_of(shown).empty()) shown.speed = std::move(fields->get("speed").values);
    shown.other_roles = other_roles(shown.part);
    clock.end();
    return shown;
}

void find_ramps(std::vector<ReportLog>& logs) {
    for (ReportLog& log : logs) {
        for (const Field& field : log.fields) {
            log.ramps.emplace_back();
            if (is_speed(field.info)) log.ramps.back() = pass_ramps(field, log.surface.passes, log.part.log.period);
        }
    }
}

std::string fit_page(io::ReportPage& page, std::vector<ReportLog>& logs) {
    PointIndex all = 0;
    for (const ReportLog& shown : logs) all += shown.surface.positions.size();
    double most = page.most_bytes > usual_rest ? static_cast<double>(page.most_bytes - usual_rest) / usual_bytes : 1e4;
    std::string text;
    constexpr int tries = 8;
    for (int k = 0; k < tries; ++k) {
        page.surfaces.clear();
        PointIndex kept = 0;
        for (ReportLog& shown : logs) {
            const double share = static_cast<double>(shown.surface.positions.size()) / static_cast<double>(all);
            choose_points(shown, std::max<PointIndex>(1000, std::llround(most * share)));
            kept += static_cast<PointIndex>(shown.kept.points.size());
            page.surfaces.push_back(page_surface(shown));
        }
        text = io::write_page(page);
        const bool whole = std::none_of(logs.begin(), logs.end(), [](const ReportLog& s) { return s.kept.reduced(); });
        const double filled = static_cast<double>(text.size()) / static_cast<double>(page.most_bytes);
        // Another try is worth it if a tenth more points fit.
        if (filled <= 1 && (whole || filled > 0.9 || k > tries / 2)) return text;
        const double rest = std::min(static_cast<double>(text.size()), static_cast<double>(usual_rest));
        const double each =
            (static_cast<double>(text.size()) - rest) / static_cast<double>(std::max<PointIndex>(1, kept));
        const double next = 0.96 * (static_cast<double>(page.most_bytes) - rest) / std::max(each, 1.0);
        most = std::max(1000.0, filled > 1 ? std::min(next, 0.9 * static_cast<double>(kept)) : next);
    }
    if (text.size() <= page.most_bytes) return text;
    throw UsageError(fmt::format("--max-size {:g}: the smallest possible page has {:.1f} MB",
                                 static_cast<double>(page.most_bytes) / 1e6, static_cast<double>(text.size()) / 1e6),
                     "its program's text and the passes' ends alone need that; fewer --fields, or a larger --max-size");
}

std::vector<io::PageColourMap> page_colour_maps() {
    std::vector<io::PageColourMap> maps;
    const auto add = [&](const std::string& name, const std::string& summary) {
        const viz::ColourMap map = viz::make_colour_map(name);
        io::PageColourMap page{name, summary, map.centred(), map.below(), map.above(), {}};
        constexpr int colours = 256;
        for (int i = 0; i < colours; ++i) {
            for (const std::uint8_t c : map.at(static_cast<double>(i) / (colours - 1)))
                page.rgb += static_cast<char>(c);
        }
        maps.push_back(std::move(page));
    };
    for (const viz::ColourMapInfo& info : viz::colour_maps()) add(std::string(info.name), std::string(info.summary));
    add("magma_r", "magma reversed, for errors");
    return maps;
}

}  // namespace clsurf::cli
