#include "io/reports/history_report.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/counted.h"
#include "core/file_name.h"
#include "io/reports/quality_words.h"
#include "predictor/severity.h"

namespace clsurf::io {
namespace {

std::string parameters_text(const RunRecord& run) {
    std::string text;
    for (const RunParameter& p : run.parameters)
        text += fmt::format("{}{}={}", text.empty() ? "" : " ", p.name, p.value);
    return text;
}

/// "2026-11-24 07:30".
std::string minute_of(const std::string& time) {
    std::string text = time.substr(0, 16);
    if (text.size() > 10) text[10] = ' ';
    return text;
}

std::string number_text(double value, int decimals) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "-";
}

/// A count or a worst value of a run, "-" of one that failed.
std::string measured_text(const RunRecord& run, double value, int decimals) {
    return run.failed() ? "-" : number_text(value, decimals);
}

/// The program; the log, if none was found for it.
std::string shown_name(const RunRecord& run) { return file_name(run.program.empty() ? run.log : run.program); }

std::string with_unit(double value, std::string_view unit) {
    return fmt::format("{:.4g}{}{}", value, unit.empty() ? "" : " ", unit);
}

std::string lines_of(const RecordedDefect& d) {
    std::string text;
    constexpr std::size_t shown = 3;
    std::set<std::pair<LineNumber, LineNumber>> lines;
    for (const RecordedSection& s : d.sections) {
        if (s.first_line != 0) lines.emplace(s.first_line, s.last_line);
    }
    std::size_t k = 0;
    for (const auto& [first, last] : lines) {
        if (k++ == shown) break;
        text += fmt::format("{}{}", text.empty() ? "" : ", ",
                            first == last ? fmt::format("{}", first) : fmt::format("{}-{}", first, last));
    }
    if (lines.size() > shown) text += fmt::format(" and {} more", lines.size() - shown);
    return text.empty() ? "-" : text;
}

std::string defect_line(const RecordedDefect& d) {
    return fmt::format("{:<13} {:<8} {:>6.1f} times the threshold  {:>6.1f} µm  {}  lines {}", d.cause,
                       name_of_severity(d.severity), d.score, d.depth_um, axes_text(d.position), lines_of(d));
}

const TrendPoint* latest(const Trend& trend) {
    for (auto at = trend.points.rbegin(); at != trend.points.rend(); ++at) {
        if (std::isfinite(at->value)) return &*at;
    }
    return nullptr;
}

std::string limit_text(const ReportedTrend& r) {
    std::size_t over = 0;
    std::size_t known = 0;
    const TrendPoint* first = nullptr;
    for (const TrendPoint& point : r.trend->points) {
        if (!std::isfinite(point.value)) continue;
        ++known;
        if (!(point.value > *r.limit)) continue;
        ++over;
        if (first == nullptr) first = &point;
    }
    if (over == 0) return fmt::format("No run is above {}.\n", with_unit(*r.limit, r.quantity->unit));
    return fmt::format("{} of {} runs are above {}, the first is run {} ({}).\n", over, known,
                       with_unit(*r.limit, r.quantity->unit), first->run, minute_of(first->time));
}

}  // namespace

std::string text_of(const DefectFilter& filter) {
    std::string text;
    const auto add = [&](const std::string& words) { text += (text.empty() ? "" : ", ") + words; };
    if (filter.pass) add(fmt::format("pass {}", *filter.pass));
    if (filter.lines) add(fmt::format("lines {}-{}", filter.lines->first, filter.lines->second));
    if (!filter.cause.empty()) add(filter.cause);
    return text;
}

std::string verdict_of(const RunRecord& run) {
    if (run.failed()) return "failed";
    if (!run.judged) return "not judged";
    if (!run.within_budget) return "over budget";
    return run.defects == 0 ? "no defects" : std::string(name_of_severity(run.worst_severity));
}

std::string trend_text(const ReportedTrend& r) {
    const std::string_view unit = r.quantity->unit;
    const std::string of = text_of(r.filter);
    const std::vector<TrendPoint>& points = r.trend->points;
    const auto runs = static_cast<std::size_t>(
        std::ranges::count_if(points, [](const TrendPoint& point) { return std::isfinite(point.value); }));
    std::string text =
        fmt::format("{}{}{} over {}: ", r.quantity->label, of.empty() ? "" : ", ", of, counted(runs, "run"));
    const TrendPoint* last = latest(*r.trend);
    if (last == nullptr) return text + "no run has a value.\n";
    text += fmt::format("{} in run {} ({}), the latest{}.\n", with_unit(last->value, unit), last->run,
                        minute_of(last->time), last == &points.back() ? "" : " with a value");
    if (runs < points.size())
        text +=
            fmt::format("{} no value: failed, or not judged.\n",
                        points.size() - runs == 1 ? "1 run has" : fmt::format("{} runs have", points.size() - runs));
    if (r.trend->change) {
        const TrendChange& c = *r.trend->change;
        const TrendPoint& since = r.trend->points[c.first];
        text += fmt::format("Since run {} ({}) the median has been {}; before that it was {} (p = {:.2g}).\n",
                            since.run, minute_of(since.time), with_unit(c.after, unit), with_unit(c.before, unit), c.p);
    } else if (runs < least_runs_for_change) {
        text += fmt::format("A change of level needs at least {} runs.\n", least_runs_for_change);
    } else {
        text += "No change of level: the differences are no larger than in a random order of the runs.\n";
    }
    if (r.limit) text += limit_text(r);
    if (!r.by.empty()) text += fmt::format("By {}:\n", r.by);
    for (const TrendGroup& group : r.trend->groups)
        text += fmt::format("  {:<16} {:>5} {:<4}  median {:>10}  highest {:>10}\n",
                            group.name.empty() ? "not given" : group.name, group.runs, group.runs == 1 ? "run" : "runs",
                            with_unit(group.median, unit), with_unit(group.most, unit));
    return text;
}

std::string history_text(std::span<const RunRecord> runs) {
    if (runs.empty()) return "no runs\n";
    std::size_t widest = 7;
    for (const RunRecord& run : runs) widest = std::max(widest, std::min<std::size_t>(28, shown_name(run).size()));
    std::string text =
        fmt::format("{:>5} {:<16} {:<{}} {:>7} {:>7} {:>8} {:>6} {:>9} {:<11} {}\n", "run", "time (UTC)", "program",
                    widest, "defects", "worst", "deepest", "Ra", "mismatch", "verdict", "parameters");
    text += fmt::format("{:>5} {:<16} {:<{}} {:>7} {:>7} {:>8} {:>6} {:>9}\n", "", "", "", widest, "", "[times]",
                        "[µm]", "[µm]", "p99 [%]");
    for (const RunRecord& run : runs) {
        std::string row = fmt::format(
            "{:>5} {:<16} {:<{}} {:>7} {:>7} {:>8} {:>6} {:>9} {:<11} {}", run.id, minute_of(run.time),
            shown_name(run).substr(0, 28), widest, measured_text(run, static_cast<double>(run.defects), 0),
            measured_text(run, run.worst_score, 1), measured_text(run, run.deepest_um, 1), number_text(run.ra_um, 2),
            number_text(run.speed_percent.p99, 1), verdict_of(run), parameters_text(run));
        row.erase(row.find_last_not_of(' ') + 1);
        text += row + "\n";
    }
    return text;
}

std::string run_text(const RunRecord& run) {
    std::string text = fmt::format("run {} of {}\n", run.id, minute_of(run.time));
    const auto fact = [&](std::string_view name, const std::string& value) {
        if (!value.empty()) text += fmt::format("  {:<12} {}\n", name, value);
    };
    fact("program", run.program);
    fact("", run.program_sha256);
    fact("log", run.log);
    fact("", run.log_sha256);
    fact("machine", run.machine);
    fact("tool", run.tool);
    fact("parameters", parameters_text(run));
    fact("recorded", fmt::format("{} by clsurf {}", minute_of(run.recorded), run.version));
    fact("duration",
         std::isfinite(run.duration_s) ? fmt::format("{:.1f} s, {} passes", run.duration_s, run.passes) : "");
    fact("verdict", verdict_of(run));
    fact("", run.not_judged_reasons);
    fact("", run.failure);
    fact("settings", run.settings);
    for (const HistoryQuantity& quantity : history_quantities()) {
        const double value = value_of(quantity, run);
        if (std::isfinite(value))
            text += fmt::format("  {:<42} {:>10}\n", quantity.label, with_unit(value, quantity.unit));
    }
    for (std::size_t i = 0; i < run.found.size(); ++i)
        text += fmt::format("{:>4} {}\n", i + 1, defect_line(run.found[i]));
    return text;
}

std::string outliers_text(std::span<const RunRecord> runs, std::span<const RunOutlier> outliers) {
    if (outliers.empty())
        return fmt::format("no outliers among {} runs (at least {} judged runs of a program are needed)\n", runs.size(),
                           least_runs_for_outliers);
    std::string text = fmt::format("{:>5} {:<16} {:<40} {:>12} {:>12} {:>7}\n", "run", "time (UTC)", "quantity",
                                   "value", "usual", "score");
    for (const RunOutlier& o : outliers)
        text += fmt::format("{:>5} {:<16} {:<40} {:>12} {:>12} {:>+7.1f}  {}\n", runs[o.run].id,
                            minute_of(runs[o.run].time), o.quantity->label, with_unit(o.value, o.quantity->unit),
                            with_unit(o.usual, o.quantity->unit), o.z, parameters_text(runs[o.run]));
    return text;
}

std::string comparison_text(const RunRecord& reference, const RunRecord& run, const RunComparison& c) {
    const std::size_t fresh = static_cast<std::size_t>(std::ranges::count(c.match.states, DefectState::fresh));
    const std::size_t worse = static_cast<std::size_t>(std::ranges::count(c.match.states, DefectState::worse));
    std::string text = fmt::format("run {} ({}) against run {} ({}): {} new defects, {} worse, {} gone, {} as before\n",
                                   run.id, minute_of(run.time), reference.id, minute_of(reference.time), fresh, worse,
                                   c.match.gone.size(), c.match.states.size() - fresh - worse);
    for (const QuantityChange& q : c.quantities) {
        if (q.before != q.after)
            text += fmt::format("  {:<42} {:>10} {:>10}  {:+.4g}\n", q.quantity->label,
                                with_unit(q.before, q.quantity->unit), with_unit(q.after, q.quantity->unit),
                                q.after - q.before);
    }
    for (std::size_t i = 0; i < run.found.size(); ++i) {
        if (c.match.states[i] != DefectState::unchanged)
            text += fmt::format("{:<5} {}\n", name_of(c.match.states[i]), defect_line(run.found[i]));
    }
    for (const std::size_t k : c.match.gone) text += fmt::format("gone  {}\n", defect_line(reference.found[k]));
    return text;
}

}  // namespace clsurf::io
