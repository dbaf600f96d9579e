#include "io/page/page_sections.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/decimal_text.h"
#include "core/file_name.h"
#include "core/units.h"
#include "core/version.h"
#include "io/files/json_value.h"
#include "io/formats/run_parameters.h"
#include "io/page/defect_cards.h"
#include "io/page/html_text.h"
#include "io/page/measured_section.h"
#include "io/reports/quality_words.h"
#include "io/reports/roughness_words.h"
#include "io/reports/simulation_origin.h"

namespace clsurf::io {
namespace {

constexpr std::size_t defects_in_table = 200;

/// "12 345 678" with thin spaces.
std::string count_text(std::int64_t number) {
    std::string digits = std::to_string(number);
    for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(static_cast<std::size_t>(at), "\u202f");
    return digits;
}

std::string duration_text(double seconds) {
    if (seconds < 120) return fmt::format("{:.3f} s", seconds);
    const auto whole = static_cast<long long>(seconds);
    if (whole < 7200) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

/// Four digits, without an exponent if possible.
std::string number_text(double value) {
    return std::abs(value) >= 1e3 && std::abs(value) < 1e7 ? fmt::format("{:.0f}", value)
                                                           : fmt::format("{:.4g}", value);
}

std::string um_text(double mm) { return std::isfinite(mm) ? fmt::format("{:.1f}", mm * um_per_mm) : "–"; }

/// One fact of the summary: name and value.
std::string fact(std::string_view name, const std::string& value, std::string_view note = {},
                 std::string_view kind = {}) {
    return fmt::format("<div{}><dt>{}</dt><dd>{}{}</dd></div>\n",
                       kind.empty() ? "" : fmt::format(" class=\"{}\"", kind), html(name), html(value),
                       note.empty() ? "" : fmt::format(" <small>{}</small>", html(note)));
}

/// The text of a key of the log's metadata; empty: missing, or not a text.
std::string metadata_text(const Log& log, const char* name) {
    const Json json = Json::parse(log.metadata, nullptr, false);
    if (!json.is_object() || !json.contains(name) || !json[name].is_string()) return {};
    return json[name].get<std::string>();
}

std::string defect_lines(const Defect& d) {
    constexpr std::size_t most_listed = 4;
    return list_of_sections(strongest_first(d), most_listed, lines_text);
}

/// Bars across the page: why there is no verdict, and what the log lacks.
std::string alarm_bars(const ReportPage& page) {
    constexpr double least_missing = 0.01;  // share of the program's motions
    const QualityReport& report = *page.quality.report;
    const PageSurface& s = page.surfaces.front();
    const auto bar = [](std::string_view what, const std::string& why) {
        return fmt::format("<p class=\"alarm\" role=\"alert\"><b>{}</b>{}</p>\n", what, why);
    };
    std::string text;
    if (!report.judgement.judged()) {
        std::string why;
        for (const std::string& reason : report.judgement.reasons) why += " " + html(reason);
        text += bar("Not judged.", why + " Findings are shown in grey and are not reliable.");
    }
    const double missing = s.lines->match().missing;
    if (!s.log->closed)
        text += bar("The log is cut off.",
                    missing > least_missing
                        ? fmt::format(" Its recording was not closed, and it lacks {:.0f} % of the program's motions.",
                                      100 * missing)
                        : " Its recording was not closed: records at its end may be missing.");
    else if (missing > least_missing && report.judgement.judged())
        text += bar("The log is not complete.",
                    fmt::format(" It lacks {:.0f} % of the program's motions; they are not judged.", 100 * missing));
    return text;
}

/// The parameters of the runs from the logs: tool, wear, coolant …; empty: none.
std::string parameter_fact(const ReportPage& page) {
    const auto listed = [](const PageSurface& of) { return list_of(parameters_of_metadata(of.log->metadata)); };
    const std::string own = listed(page.surfaces.front());
    const std::string before = page.surfaces.size() > 1 ? listed(page.surfaces.back()) : own;
    if (own.empty() && before.empty()) return {};
    const std::string note = before == own ? "" : "before: " + (before.empty() ? "none" : before);
    return fact("Parameters", own.empty() ? "none" : own, note, "parameters");
}

/// The machine of the log, and whether the log was recorded or simulated; empty: nothing is known.
std::string machine_fact(const ReportPage& page) {
    const std::optional<SimulationOrigin>& own = page.quality.origin;
    const std::optional<SimulationOrigin> before =
        page.surfaces.size() > 1 ? simulation_origin(*page.surfaces.back().log) : own;
    const std::string recorded = metadata_text(*page.surfaces.front().log, "machine");
    const std::string name = own ? own->machine : recorded;
    if (name.empty() && !own && !before) return {};
    std::string note = own ? "simulated" : before ? "recorded" : "";
    if (own.has_value() != before.has_value()) note += before ? "; before: simulated" : "; before: recorded";
    return fact("Machine", name.empty() ? "not named" : name, note, "machine");
}

/// When and how the log was recorded.
std::string run_facts(const ReportPage& page) {
    const QualityReport& report = *page.quality.report;
    const Log& log = *page.surfaces.front().log;
    std::string text;
    const std::string recorded = metadata_text(log, "recorded");
    if (!recorded.empty())
        text += fact("Recorded", recorded);
    else if (!page.log_date.empty())
        text += fact("Date", page.log_date, "of the file");
    text += machine_fact(page);
    if (page.quality.tool) text += fact("Tool", to_text(*page.quality.tool));
    text += parameter_fact(page);
    text +=
        fact("Duration", duration_text(log.time_of(log.records - 1)), fmt::format("every {:g} ms", log.period * 1e3));
    text += fact("Points", count_text(log.records), fmt::format("{} log", log.format));
    text += fact("Passes", count_text(report.passes),
                 report.step_over > 0 ? fmt::format("{:.3g} mm apart", report.step_over) : "");
    return text;
}

/// "1 trace (in the data, hardly on the part), 2 visible (…), …".
std::string severities_text() {
    std::string text;
    for (int k = 1; k <= severities; ++k)
        text += fmt::format("{}{} {} ({})", k > 1 ? ", " : "", k, name_of_severity(k), meaning_of_severity(k));
    return text;
}

std::string defects_section(const ReportPage& page) {
    const QualityReport& report = *page.quality.report;
    std::string text = "<section id=\"defects\"><h2>Defects</h2>\n";
    if (report.step_over <= 0)
        return text + "<p>No pass has an adjacent pass, so nothing can be compared.</p></section>\n";
    text += fmt::format(
        "<p><b>{}</b> {} passes, {:.3g} mm apart. A defect is a place where a pass differs from its neighbours enough to leave a mark.</p>\n",
        html(verdict_of(report)), report.passes, report.step_over);
    if (!report.defects.empty()) {
        text += fmt::format(
            "<p><a href=\"#defect-list\">All defects are listed below</a>, worst first. Severity: {}.</p>\n<div class=\"pictures\">\n",
            severities_text());
        for (std::size_t i = 0; i < page.defects.size(); ++i) {
            if (page.defects[i].picture) text += defect_card_html(page, i);
        }
        text += "</div>\n";
    }
    if (!report.expected.empty())
        text += fmt::format("<p>Not counted: {} at the border of the part, where a pass has only one neighbour.</p>\n",
                            report.expected.size());
    return text + "</section>\n";
}

/// The user's comment on a defect.
std::string accepted_note(const ReportPage& page, std::size_t defect) {
    if (page.quality.acceptance == nullptr) return {};
    const Acceptance::Entry& entry = page.quality.acceptance->of_defect[defect];
    if (!entry.accepted && entry.comment.empty()) return {};
    return fmt::format("<br><small>{}{}{}</small>", entry.accepted ? "accepted" : "",
                       entry.accepted && !entry.comment.empty() ? ": " : "", html(entry.comment));
}

/// The roughness of both logs, as a table.
std::string roughness_change_html(const PageChange& change) {
    if (!change.roughness) return {};
    std::string rows;
    write_roughness_change(*change.roughness, [&](std::string_view name, double before, double after) {
        const std::string by = before > 0 ? signed_text(100 * (after / before - 1), 1) + " %" : "–";
        rows += fmt::format("<tr><td>{}</td><td>{:.2f}</td><td>{:.2f}</td><td>{}</td></tr>\n", html(name), before,
                            after, by);
    });
    if (rows.empty()) return {};
    return "<p>Both surfaces at the same places, over the form of the log before:</p>\n" +
           wide_table("roughness before and after",
                      "<th>As-machined surface</th><th>before</th><th>after</th><th>change</th>", rows);
}

/// The changes in defects and surface since the earlier log.
std::string change_section(const ReportPage& page) {
    if (!page.change) return {};
    const DefectMatch& match = page.change->match;
    const std::vector<Defect>& before = page.change->before->defects;
    std::string text = fmt::format(
        "<section id=\"change\"><h2>Before and after</h2>\n<p><b>Of {} defects before, {} {} gone. Of {} now, {} "
        "{} new and {} {} there before.</b></p>\n",
        before.size(), match.gone.size(), match.gone.size() == 1 ? "is" : "are", match.before_of.size(), match.fresh(),
        match.fresh() == 1 ? "is" : "are", match.remaining(), match.remaining() == 1 ? "was" : "were");
    const auto row = [](std::string_view what, std::size_t id, const Defect& d) {
        return fmt::format(
            "<tr><td>{}</td><td>{}</td><td><span class=\"severity s{}\">{}</span> {}</td><td>{}</td><td>{}</td></tr>\n",
            what, id, d.severity, d.severity, name_of_severity(d.severity), html(sentence_of(d)),
            html(defect_lines(d)));
    };
    std::string rows;
    for (std::size_t i = 0; i < std::min(match.gone.size(), defects_in_table); ++i)
        rows += row("gone", match.gone[i] + 1, before[match.gone[i]]);
    for (std::size_t i = 0; i < std::min(match.before_of.size(), defects_in_table); ++i) {
        if (!match.before_of[i]) rows += row("new", i + 1, page.quality.report->defects[i]);
    }
    if (!rows.empty())
        text += wide_table("gone and new defects",
                           "<th>Defect</th><th>Rank</th><th>Severity</th><th>Finding</th><th>Lines</th>", rows);
    return text + roughness_change_html(*page.change) + "</section>\n";
}

/// The last section, because it can fill many sheets.
std::string defect_list_section(const ReportPage& page) {
    const QualityReport& report = *page.quality.report;
    if (report.defects.empty()) return "";
    const bool as_machined = page.quality.as_machined != nullptr;
    const std::string head = fmt::format(
        "<th>Rank</th><th>Severity</th><th>Finding</th><th>Times the threshold</th><th>Depth [µm]</th>{}<th>Speed [%]</th>"
        "<th>Length [mm]</th><th>X Y Z [mm]</th><th>Lines</th>",
        as_machined ? "<th>Formed [µm]</th>" : "");
    std::string rows;
    for (std::size_t i = 0; i < std::min(defects_in_table, report.defects.size()); ++i) {
        const Defect& d = report.defects[i];
        rows += fmt::format(
            "<tr data-defect=\"{}\"><td>{}</td><td><span class=\"severity s{}\">{}</span> {}</td><td>{}</td><td>{:.1f}</td><td>{}</td>{}<td>{}</td><td>{:.1f}</td><td>{}</td><td>{}</td></tr>\n",
            i + 1, i + 1, d.severity, d.severity, name_of_severity(d.severity),
            html(sentence_of(d)) + accepted_note(page, i), d.score, depth_text(d, ""),
            as_machined ? fmt::format("<td>{}</td>", um_text(page.quality.as_machined->marks[i].depth)) : "",
            signed_text(100 * d.speed_mismatch, 1), d.length, coordinates_text(d.place.position()),
            html(defect_lines(d)));
    }
    std::string text =
        "<section id=\"defect-list\"><h2>All defects</h2>\n" + wide_table("table of all defects", head, rows);
    if (report.defects.size() > defects_in_table)
        text += fmt::format("<p>The table stops at the first {}; <code>clsurf check</code> lists all.</p>\n",
                            defects_in_table);
    return text + "</section>\n";
}

std::string numbers_section(const ReportPage& page) {
    const QualityReport& report = *page.quality.report;
    std::string rows;
    for (const PagePercentiles& row : page.percentiles) {
        const FieldInfo* info = nullptr;
        for (const Field& field : page.surfaces.front().fields) {
            if (field.info.name == row.field) info = &field.info;
        }
        if (info == nullptr) continue;
        rows += fmt::format("<tr><td>{}</td>", html(info->label));
        for (const double value : row.of_magnitude)
            rows += std::isfinite(value) ? fmt::format("<td>{}</td>", number_text(value)) : "<td>–</td>";
        rows += fmt::format("<td>{}</td></tr>\n", html(info->unit.name));
    }
    std::string text =
        "<section id=\"numbers\"><h2>Adjacent passes in numbers</h2>\n" +
        wide_table("numbers", "<th>Size of</th><th>50 %</th><th>90 %</th><th>99 %</th><th>maximum</th><th>unit</th>",
                   rows);
    const std::string thresholds = thresholds_text(report);
    if (!thresholds.empty())
        text += fmt::format("<p>Thresholds of a defect: {}; {}.</p>\n", html(thresholds), html(report.note));
    if (page.quality.as_machined != nullptr && !page.quality.as_machined->roughness.patches.empty()) {
        const PartRoughness& f = page.quality.as_machined->roughness;
        text += fmt::format(
            "<p>As-machined surface with {}, {} patches: Ra {:.2f}, Rz {:.2f} (at most {:.2f}), Sa {:.2f}, Sz {:.2f} µm, {}.</p>\n",
            html(to_text(*page.quality.tool)), f.patches.size(), f.ra * um_per_mm, f.rz * um_per_mm,
            f.patches[f.roughest].profile.rz * um_per_mm, f.sa * um_per_mm, f.sz * um_per_mm, cutoff_text(f.cutoff));
        text += fmt::format("<p>The form is not known on {:.0f} % of these patches: nothing is measured there.</p>\n",
                            100 * f.unknown);
        if (f.machine.cells > 0)
            text += fmt::format(
                "<p>Of this the machine adds Sa {:.2f}, Sz {:.2f} µm to what the commanded path leaves, creases and fillets included.</p>\n",
                f.machine.sa * um_per_mm, f.machine.sz * um_per_mm);
    } else {
        text += "<p>Roughness needs the tool: <code>--tool ball:D</code>.</p>\n";
    }
    return text + "</section>\n";
}

std::string health_section(const ReportPage& page) {
    std::string text = "<section id=\"health\"><h2>Can the log be trusted?</h2>\n";
    if (page.quality.origin) text += "<p>" + html(origin_text(page.quality.origin)) + "</p>\n";
    if (page.health.empty()) return text + "<p>No problems found.</p></section>\n";
    text += "<ul>\n";
    for (const Diagnostic& d : page.health.summary()) {
        const std::string where = d.where.text();
        text += fmt::format("<li class=\"{}\"><b>{}</b> {}{}{}{}</li>\n", name_of(d.severity), name_of(d.severity),
                            html(where), where.empty() ? "" : ": ", html(d.text),
                            d.hint.empty() ? "" : fmt::format(" <small>{}</small>", html(d.hint)));
    }
    return text + "</ul></section>\n";
}

std::string kept_text(const PageSurface& surface) {
    const KeptPoints& kept = *surface.kept;
    const std::string log = html(file_name(surface.log->name));
    if (!kept.reduced())
        return fmt::format("<li>{}: all {} points are in this page.</li>\n", log, count_text(kept.all));
    return fmt::format(
        "<li>{}: {} of {} points are in this page. Of each {} consecutive points of a pass, the page keeps the first one and the lowest and highest value of each field. It also keeps "
        "the ends of passes, {}and {}. The first and last point of each line is known for all lines. Numbers, percentiles, "
        "defects and pictures on this page use all points.</li>\n",
        log, count_text(static_cast<std::int64_t>(kept.points.size())), count_text(kept.all), count_text(kept.window),
        kept.line_starts ? "the first point of each line, " : "",
        kept.whole_defects == kept.defects
            ? "every point of a defect and of the passes adjacent to it"
            : fmt::format(
                  "every point of {} of {} defects and of the passes adjacent to them (the others are too large)",
                  kept.whole_defects, kept.defects));
}

std::string contents_section(const ReportPage& page) {
    std::string text = "<section id=\"contents\"><h2>Contents of this page</h2>\n<ul>\n";
    for (const PageSurface& surface : page.surfaces) text += kept_text(surface);
    text += fmt::format(
        "<li>Positions in steps of 0.1 µm, values in steps of 1/32768 of the colour range; size limit {:.4g} MB (<code>--max-size</code>).</li>\n",
        static_cast<double>(page.most_bytes) / 1e6);
    for (const Field& field : page.surfaces.front().fields) {
        if (!field.info.note.empty())
            text += fmt::format("<li>{}: {}.</li>\n", html(field.info.label), html(field.info.note));
    }
    return text + "</ul></section>\n";
}

}  // namespace

std::string page_title(const ReportPage& page) { return file_name(page.program) + " · " + file_name(page.log); }

std::string page_summary(const ReportPage& page) {
    const QualityReport& report = *page.quality.report;
    std::string text = fmt::format("<header id=\"summary\">\n<h1>{} <small>{}{} · clsurf {}</small></h1>\n<dl>\n",
                                   html(file_name(page.program)), html(file_name(page.log)),
                                   page.before.empty() ? "" : html(" · before: " + file_name(page.before)), version);
    text += run_facts(page);
    int worst = 0;
    const Defect* largest = nullptr;
    for (const Defect& d : report.defects) {
        worst = std::max(worst, d.severity);
        if (largest == nullptr || d.depth > largest->depth) largest = &d;
    }
    const bool judged = report.judgement.judged();
    const std::size_t accepted = page.quality.acceptance != nullptr ? page.quality.acceptance->count() : 0;
    text += fact("Defects",
                 !judged        ? "not judged"
                 : accepted > 0 ? fmt::format("{}, {} accepted", report.defects.size(), accepted)
                                : fmt::format("{}", report.defects.size()),
                 judged                   ? worst > 0 ? name_of_severity(worst) : std::string_view()
                                   : report.defects.empty() ? ""
                                          : fmt::format("{} found", report.defects.size()),
                 !judged || worst > 2 ? "bad"
                 : worst > 0          ? "fair"
                                      : "good");
    if (worst > 0) text += fact("Largest mark", depth_text(*largest, " µm"));
    for (const PagePercentiles& row : page.percentiles) {
        if (row.field == "speed_mismatch" && std::isfinite(row.of_magnitude[2]))
            text += fact("Speed mismatch",
                         fmt::format("{:.{}f} mm/min", row.of_magnitude[2], row.of_magnitude[2] < 10 ? 2 : 0), "p99");
    }
    if (page.quality.as_machined != nullptr && !page.quality.as_machined->roughness.patches.empty()) {
        text += fact("Roughness", fmt::format("Rz {:.2f} µm", page.quality.as_machined->roughness.rz * um_per_mm),
                     fmt::format("Ra {:.2f} µm, {}", page.quality.as_machined->roughness.ra * um_per_mm,
                                 to_text(*page.quality.tool)));
    }
    const std::uint64_t warnings = page.health.count(Severity::warning) + page.health.count(Severity::error);
    text += fact("Log health",
                 page.health.has_errors() ? "errors"
                 : warnings > 0           ? "warnings"
                                          : "sound",
                 warnings > 0 ? fmt::format("{} found", warnings) : "",
                 page.health.has_errors() ? "bad"
                 : warnings > 0           ? "fair"
                                          : "good");
    return text + "</dl>\n" + alarm_bars(page) + "</header>\n";
}

std::string page_sections(const ReportPage& page) {
    std::string text = "<main id=\"report\">\n";
    if (!page.pictures.empty()) {
        text += "<section id=\"maps\"><h2>Maps</h2>\n<div class=\"pictures\">\n";
        for (const PagePicture& picture : page.pictures) text += picture_html(picture);
        text += "</div></section>\n";
    }
    text += change_section(page) + defects_section(page) + numbers_section(page) + measured_section(page) +
            health_section(page) + defect_list_section(page) + contents_section(page);
    return text + "</main>\n";
}

}  // namespace clsurf::io
