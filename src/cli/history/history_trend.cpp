// clsurf history DB trend: a quantity over runs, as text and as a picture.

#include <algorithm>

#include <fmt/format.h>

#include "cli/history/history_options.h"
#include "cli/history/history_verbs.h"
#include "cli/pictures/picture_output.h"
#include "core/file_name.h"
#include "io/reports/history_report.h"
#include "viz/trend_chart.h"

namespace clsurf::cli {
namespace {

constexpr std::size_t most_groups = 12;

/// For passes or lines, all runs must be of one program. Throws UsageError otherwise.
void require_one_program(const std::vector<RunRecord>& runs) {
    std::vector<std::string_view> names;
    for (const RunRecord& run : runs) {
        if (std::ranges::find(names, file_name(run.program)) == names.end())
            names.push_back(std::string_view(run.program).substr(run.program.rfind('/') + 1));
    }
    if (names.size() < 2) return;
    std::string list;
    for (const std::string_view name : names) list += (list.empty() ? "" : ", ") + std::string(name);
    throw UsageError("passes and lines are those of one program, but the runs are of " + list,
                     "choose one with --program");
}

/// The names of the groups in the order of the legend: that of the trend, then those without a value.
std::vector<std::string> legend_of(const Trend& trend) {
    std::vector<std::string> names;
    for (const TrendGroup& group : trend.groups) names.push_back(group.name);
    for (const TrendPoint& point : trend.points) {
        if (std::ranges::find(names, point.group) == names.end()) names.push_back(point.group);
    }
    return names;
}

viz::TrendPicture picture_of(const io::ReportedTrend& r) {
    viz::TrendPicture picture;
    picture.groups = legend_of(*r.trend);
    if (picture.groups.size() > most_groups)
        throw UsageError(fmt::format("--by {}: the runs have {} different values, at most {} can be drawn", r.by,
                                     picture.groups.size(), most_groups),
                         "choose fewer runs with --where, --since or --last");
    for (const TrendPoint& point : r.trend->points) {
        const auto group = std::ranges::find(picture.groups, point.group) - picture.groups.begin();
        picture.symbols.push_back(
            {point.value, fmt::format("{}", point.run), point.time.substr(0, 10), static_cast<std::size_t>(group)});
    }
    picture.y_label =
        fmt::format("{}{}", r.quantity->label, r.quantity->unit.empty() ? "" : fmt::format(" [{}]", r.quantity->unit));
    picture.limit = r.limit;
    if (const auto& change = r.trend->change)
        picture.levels = viz::TrendLevels{change->first, change->before, change->after,
                                          fmt::format("since run {}", r.trend->points[change->first].run)};
    return picture;
}

/// The second sentence of the answer, for the subtitle.
std::string second_sentence(const std::string& text) {
    const std::size_t begin = text.find('\n') + 1;
    return text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace

ExitCode show_trend(const HistoryCall& call) {
    TrendOptions options = read_trend_options(call.values);
    const bool json = read_json_with_output(call.values);
    std::optional<PictureOutput> output;
    if (!options.output.empty()) output.emplace(options.output, "-o", PictureKind::drawing);
    io::guard_input(call.database);
    const io::HistoryDatabase history(call.database);
    std::vector<RunRecord> runs = history.runs(read_run_choice(call.values));
    if (runs.empty()) throw InputError(Place::of_file(call.database), "has no such runs");
    if (options.filter.pass || options.filter.lines) require_one_program(runs);
    if (!options.filter.empty()) history.read_defects(runs, options.filter);
    const Trend trend = make_trend(runs, *options.quantity, options.filter, options.by);
    if (!options.by.empty() && std::ranges::all_of(trend.points, [](const TrendPoint& p) { return p.group.empty(); }))
        throw UsageError("--by: no run has a parameter '" + options.by + "'");
    const io::ReportedTrend reported{&trend, options.quantity, options.filter, options.by, options.limit};
    const std::string text = io::trend_text(reported);
    if (output) {
        const std::string of = io::text_of(options.filter);
        options.look.title =
            fmt::format("{}{} · {}", options.quantity->label, of.empty() ? "" : ", " + of, file_name(call.database));
        options.look.subtitle = trend.points.size() > 1 ? second_sentence(text) : "";
        options.look.x_label = "run";
        if (!options.by.empty()) options.look.footnote = "marked by " + options.by;
        options.look.keep_drawing = output->wants_drawing();
        output->write(viz::draw_trend(picture_of(reported), options.look), options.look.title);
    }
    if (json)
        write_to_stdout(io::trend_json(reported));
    else
        write_answer(text, call.values);
    return ExitCode::done;
}

}  // namespace clsurf::cli
