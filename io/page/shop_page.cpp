#include "io/page/shop_page.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/file_name.h"
#include "core/version.h"
#include "history/trend.h"
#include "io/page/html_text.h"
#include "io/page/page_policy.h"
#include "io/page/shop_style.h"
#include "io/page/svg_chart.h"
#include "io/reports/history_report.h"

namespace clsurf::io {
namespace {

constexpr std::size_t most_runs_in_table = 200;
constexpr std::size_t most_outliers = 30;
constexpr std::size_t most_programs = 30;
constexpr const char* shown_quantities[] = {"worst_score", "defects", "deepest_um", "speed_mismatch_p99_percent",
                                            "ra_um"};

std::string day_of(const std::string& time) { return time.substr(0, 10); }

std::string parameters_of(const RunRecord& run) {
    std::string text;
    for (const RunParameter& p : run.parameters)
        text += fmt::format("{}{}={}", text.empty() ? "" : ", ", p.name, p.value);
    return text;
}

/// Programs by number of runs; the index determines the colour.
std::vector<std::string> programs_of(std::span<const RunRecord> runs) {
    std::map<std::string, std::size_t> count;
    for (const RunRecord& run : runs) ++count[file_name(run.program)];
    std::vector<std::string> names;
    for (const auto& [name, number] : count) names.push_back(name);
    std::ranges::stable_sort(names, std::ranges::greater{}, [&](const std::string& name) { return count[name]; });
    return names;
}

std::size_t colour_of(const std::vector<std::string>& programs, const RunRecord& run) {
    const auto at = static_cast<std::size_t>(std::ranges::find(programs, file_name(run.program)) - programs.begin());
    return std::min(at, svg_groups - 1);
}

std::string legend(const std::vector<std::string>& programs) {
    if (programs.size() < 2) return {};
    std::string text = "<p class=\"legend\">";
    for (std::size_t k = 0; k < std::min(programs.size(), svg_groups); ++k) {
        const bool others = k + 1 == svg_groups && programs.size() > svg_groups;
        text += fmt::format("<span>{}{}</span> ", svg_symbol(k),
                            others ? fmt::format("{} other programs", programs.size() - k) : html(programs[k]));
    }
    return text + "</p>\n";
}

std::string trend_figure(const ShopPage& page, const HistoryQuantity& quantity,
                         const std::vector<std::string>& programs) {
    const Trend trend = make_trend(page.runs, quantity, {}, "");
    const bool known = std::ranges::any_of(trend.points, [](const TrendPoint& p) { return std::isfinite(p.value); });
    if (!known) return {};
    SvgTrend svg;
    svg.title = std::string(quantity.label) + " over runs";
    ReportedTrend reported;
    reported.trend = &trend;
    reported.quantity = &quantity;
    svg.description = trend_text(reported);
    svg.counts = quantity.unit.empty();
    for (std::size_t i = 0; i < trend.points.size(); ++i) {
        const RunRecord& run = page.runs[i];
        const std::string parameters = parameters_of(run);
        svg.points.push_back(
            {trend.points[i].value,
             fmt::format("run {}, {}, {}{}: {:.4g} {}", run.id, day_of(run.time), file_name(run.program),
                         parameters.empty() ? "" : ", " + parameters, trend.points[i].value, quantity.unit),
             day_of(run.time), colour_of(programs, run)});
    }
    std::string note;
    if (trend.change) {
        svg.change = trend.change->first;
        svg.before = trend.change->before;
        svg.after = trend.change->after;
        const TrendPoint& since = trend.points[trend.change->first];
        note = fmt::format(" Since run {} ({}) the median has been {:.4g}; before that it was {:.4g}.", since.run,
                           day_of(since.time), svg.after, svg.before);
    }
    return fmt::format("<figure><figcaption><b>{}</b>{}{}</figcaption>{}</figure>\n", html(quantity.label),
                       quantity.unit.empty() ? "" : html(fmt::format(" [{}]", quantity.unit)), html(note),
                       svg_trend(svg));
}

std::string trends_section(const ShopPage& page, const std::vector<std::string>& programs) {
    std::string text =
        "<section id=\"trends\"><h2>Trends</h2>\n<p>One symbol for each run, in the order of their times. A dashed line marks where the level changes.</p>\n" +
        legend(programs);
    for (const char* name : shown_quantities) text += trend_figure(page, find_history_quantity(name), programs);
    return text + "</section>\n";
}

/// The defects of the page's runs by cause, most frequent first.
std::vector<SvgBar> causes_of(const ShopPage& page) {
    std::set<std::int64_t> shown;
    for (const RunRecord& run : page.runs) shown.insert(run.id);
    std::map<std::string, double> count;
    for (const CauseCount& cause : page.causes) {
        if (shown.contains(cause.run)) count[cause.cause] += static_cast<double>(cause.defects);
    }
    std::vector<SvgBar> bars;
    for (const auto& [name, defects] : count) bars.push_back({name, defects});
    std::ranges::stable_sort(bars, std::ranges::greater{}, &SvgBar::value);
    return bars;
}

std::string causes_section(const ShopPage& page) {
    const std::vector<SvgBar> bars = causes_of(page);
    std::string text = "<section id=\"causes\"><h2>Causes</h2>\n";
    if (bars.empty()) return text + "<p>No defects.</p></section>\n";
    double total = 0;
    for (const SvgBar& bar : bars) total += bar.value;
    text += fmt::format(
        "<figure><figcaption><b>Defects by cause</b> in {} runs: bars are defects, the line is their cumulative share.</figcaption>{}</figure>\n",
        page.runs.size(), svg_pareto("Defects by cause", bars));
    text +=
        "<table><thead><tr><th scope=\"col\">Cause</th><th scope=\"col\">Defects</th><th scope=\"col\">Share</th></tr></thead><tbody>\n";
    for (const SvgBar& bar : bars)
        text += fmt::format("<tr><td>{}</td><td class=\"n\">{:g}</td><td class=\"n\">{:.1f} %</td></tr>\n",
                            html(bar.name), bar.value, 100 * bar.value / total);
    return text + "</tbody></table></section>\n";
}

/// The row of a program. Runs without a verdict count as runs only.
struct ProgramRow {
    std::string name;
    std::size_t runs = 0, judged = 0, over_budget = 0;
    double defects = 0, highest = 0, deepest = 0;
    const RunRecord* latest = nullptr;
};

std::string cell_text(bool known, double value) { return known ? fmt::format("{:.1f}", value) : "–"; }

std::vector<ProgramRow> program_rows(std::span<const RunRecord> runs) {
    std::map<std::string, ProgramRow> rows;
    for (const RunRecord& run : runs) {
        ProgramRow& row = rows[file_name(run.program)];
        row.name = file_name(run.program);
        ++row.runs;
        row.latest = &run;
        if (!run.judged) continue;
        ++row.judged;
        row.over_budget += run.within_budget ? 0 : 1;
        row.defects += static_cast<double>(run.defects);
        row.highest = std::max(row.highest, run.worst_score);
        row.deepest = std::max(row.deepest, run.deepest_um);
    }
    std::vector<ProgramRow> sorted;
    for (auto& [name, row] : rows) sorted.push_back(std::move(row));
    std::ranges::stable_sort(sorted, std::ranges::greater{}, &ProgramRow::highest);
    return sorted;
}

std::string programs_section(const ShopPage& page) {
    const std::vector<ProgramRow> rows = program_rows(page.runs);
    std::string text =
        "<section id=\"programs\"><h2>Worst programs</h2>\n<div class=\"wide\"><table><thead><tr><th scope=\"col\">Program</th><th scope=\"col\">Runs</th><th scope=\"col\">Not judged</th><th scope=\"col\">Over budget</th>"
        "<th scope=\"col\">Defects per run</th><th scope=\"col\">Highest score</th><th scope=\"col\">Deepest [µm]</th><th scope=\"col\">Latest run</th><th scope=\"col\">Its score</th></tr></thead><tbody>\n";
    for (std::size_t i = 0; i < std::min(rows.size(), most_programs); ++i) {
        const ProgramRow& r = rows[i];
        text += fmt::format(
            "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td>{} ({})</td><td class=\"n\">{}</td></tr>\n",
            html(r.name), r.runs, r.runs - r.judged, r.over_budget,
            cell_text(r.judged > 0, r.defects / static_cast<double>(r.judged)), cell_text(r.judged > 0, r.highest),
            cell_text(r.judged > 0, r.deepest), r.latest->id, day_of(r.latest->time),
            cell_text(r.latest->judged, r.latest->worst_score));
    }
    text += "</tbody></table></div>\n";
    if (rows.size() > most_programs)
        text += fmt::format("<p>The first {} of {} programs.</p>\n", most_programs, rows.size());
    return text + "</section>\n";
}

std::string outliers_section(const ShopPage& page) {
    std::string text = "<section id=\"outliers\"><h2>Runs that stand out</h2>\n";
    if (page.outliers.empty())
        return text +
               fmt::format("<p>None among the runs of one program; at least {} of them are needed.</p></section>\n",
                           least_runs_for_outliers);
    text +=
        "<div class=\"wide\"><table><thead><tr><th scope=\"col\">Run</th><th scope=\"col\">Day</th><th scope=\"col\">Program</th><th scope=\"col\">Quantity</th><th scope=\"col\">Value</th><th scope=\"col\">Usual</th><th scope=\"col\">Parameters</th></tr></thead><tbody>\n";
    for (std::size_t i = 0; i < std::min(page.outliers.size(), most_outliers); ++i) {
        const RunOutlier& o = page.outliers[i];
        const RunRecord& run = page.runs[o.run];
        text += fmt::format(
            "<tr><td class=\"n\">{}</td><td>{}</td><td>{}</td><td>{}</td><td class=\"n\">{:.4g}</td><td class=\"n\">{:.4g}</td><td>{}</td></tr>\n",
            run.id, day_of(run.time), html(file_name(run.program)),
            html(fmt::format("{}{}", o.quantity->label,
                             o.quantity->unit.empty() ? "" : fmt::format(" [{}]", o.quantity->unit))),
            o.value, o.usual, html(parameters_of(run)));
    }
    return text + "</tbody></table></div></section>\n";
}

std::string runs_section(const ShopPage& page) {
    std::string text =
        "<section id=\"runs\"><h2>Runs</h2>\n<div class=\"wide\"><table><thead><tr><th scope=\"col\">Run</th><th scope=\"col\">Time (UTC)</th><th scope=\"col\">Program</th><th scope=\"col\">Machine</th><th scope=\"col\">Defects</th><th scope=\"col\">Worst score</th><th scope=\"col\">Deepest [µm]</th>"
        "<th scope=\"col\">Verdict</th><th scope=\"col\">Parameters</th></tr></thead><tbody>\n";
    const std::size_t count = std::min(page.runs.size(), most_runs_in_table);
    for (std::size_t k = 0; k < count; ++k) {
        const RunRecord& run = page.runs[page.runs.size() - 1 - k];
        text += fmt::format(
            "<tr><td class=\"n\">{}</td><td>{} {}</td><td>{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td><td>{}</td></tr>\n",
            run.id, day_of(run.time), run.time.substr(11, 5), html(file_name(run.program)), html(run.machine),
            run.failed() ? "–" : fmt::format("{}", run.defects), cell_text(!run.failed(), run.worst_score),
            cell_text(!run.failed(), run.deepest_um), verdict_of(run), html(parameters_of(run)));
    }
    text += "</tbody></table></div>\n";
    if (count < page.runs.size()) text += fmt::format("<p>The latest {} of {} runs.</p>\n", count, page.runs.size());
    return text + "</section>\n";
}

std::string summary(const ShopPage& page, std::size_t programs) {
    std::size_t judged = 0;
    std::size_t over = 0;
    for (const RunRecord& run : page.runs) {
        judged += run.judged ? 1 : 0;
        over += run.judged && !run.within_budget ? 1 : 0;
    }
    return fmt::format(
        "<header><h1>{} <small>clsurf {}</small></h1>\n<p>{} runs of {} program{} from {} to {}: {} judged{}.</p></header>\n",
        html(file_name(page.database)), version, page.runs.size(), programs, programs == 1 ? "" : "s",
        day_of(page.runs.front().time), day_of(page.runs.back().time), judged,
        over > 0 ? fmt::format(", {} of them over their budget", over) : std::string());
}

}  // namespace

std::string write_shop_page(const ShopPage& page) {
    const std::vector<std::string> programs = programs_of(page.runs);
    return fmt::format(
               "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src {}; base-uri 'none'; form-action 'none'\">\n"
               "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta name=\"color-scheme\" content=\"light dark\">\n<meta name=\"referrer\" content=\"no-referrer\">\n<title>{} · history of runs</title>\n<style>",
               source_hash(shop_style), html(file_name(page.database))) +
           shop_style + "</style>\n</head>\n<body>\n<main>\n" + summary(page, programs.size()) +
           trends_section(page, programs) + causes_section(page) + programs_section(page) + outliers_section(page) +
           runs_section(page) + "</main>\n</body>\n</html>\n";
}

}  // namespace clsurf::io
