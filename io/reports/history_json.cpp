#include "io/reports/history_json.h"

#include <cmath>
#include <map>
#include <utility>

#include "core/units.h"
#include "io/reports/history_report.h"
#include "io/reports/quality_words.h"

namespace clsurf::io {
namespace {

Json known_text(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json filter_object(const DefectFilter& filter) {
    Json json{{"pass", nullptr}, {"lines", nullptr}, {"cause", known_text(filter.cause)}};
    if (filter.pass) json["pass"] = *filter.pass;
    if (filter.lines) json["lines"] = Json::array({filter.lines->first, filter.lines->second});
    return json;
}

Json defect_list(const std::vector<RecordedDefect>& defects) {
    Json all = Json::array();
    for (const RecordedDefect& defect : defects) all.push_back(defect_object(defect));
    return all;
}

/// A count or a worst value; null for a failed run, whose zero would mean no defects.
Json measured(const RunRecord& run, Json value) { return run.failed() ? Json(nullptr) : std::move(value); }

}  // namespace

Json run_object(const RunRecord& run) {
    Json parameters = Json::object();
    for (const RunParameter& p : run.parameters) parameters[p.name] = p.value;
    return {{"id", run.id},
            {"time", run.time},
            {"program", run.program},
            {"program_sha256", known_text(run.program_sha256)},
            {"log_sha256", known_text(run.log_sha256)},
            {"machine", known_text(run.machine)},
            {"duration_s", number(run.duration_s, 3)},
            {"defects", measured(run, run.defects)},
            {"worst_score", measured(run, number(run.worst_score, 2))},
            {"deepest_um", measured(run, number(run.deepest_um, 3))},
            {"ra_um", number(run.ra_um, 3)},
            {"speed_mismatch_p99_percent", number(run.speed_percent.p99, 3)},
            {"judged", run.judged},
            {"within_budget", run.within_budget},
            {"parameters", std::move(parameters)},
            {"log", run.log},
            {"tool", known_text(run.tool)},
            {"failure", known_text(run.failure)}};
}

Json defect_object(const RecordedDefect& d) {
    Json passes = Json::array();
    Json lines = Json::array();
    for (const RecordedSection& s : d.sections) {
        passes.push_back(s.pass);
        lines.push_back(Json::array({s.first_line, s.last_line}));
    }
    return {{"cause", d.cause},
            {"quantity", d.quantity},
            {"severity", d.severity},
            {"score", number(d.score, 2)},
            {"depth_um", number(d.depth_um, 3)},
            {"shape", shape_of(d.systematic, d.depth_um / um_per_mm, d.pit)},
            {"systematic", d.systematic},
            {"speed_jump_percent", number(d.speed_jump_percent, 1)},
            {"length_mm", number(d.length_mm, 3)},
            {"area_mm2", number(d.area_mm2, 4)},
            {"position_mm", vector(d.position)},
            {"tip_mm", vector(d.tip)},
            {"passes", std::move(passes)},
            {"lines", std::move(lines)}};
}

std::string history_json(std::span<const RunRecord> runs) {
    Json all = Json::array();
    for (const RunRecord& run : runs) all.push_back(run_object(run));
    return dump(Json{{"runs", std::move(all)}});
}

std::string run_json(const RunRecord& run) {
    Json json = run_object(run);
    json["recorded"] = run.recorded;
    json["version"] = run.version;
    json["settings"] = run.settings;
    json["points"] = measured(run, run.points);
    json["passes"] = measured(run, run.passes);
    json["not_judged_reasons"] = known_text(run.not_judged_reasons);
    json["worst_severity"] = measured(run, run.worst_severity);
    for (const HistoryQuantity& quantity : history_quantities()) {
        const std::string key(quantity.name);
        if (!json.contains(key)) json[key] = number(value_of(quantity, run), 3);
    }
    std::map<std::string, int> causes;
    for (const RecordedDefect& defect : run.found) ++causes[defect.cause];
    json["causes"] = Json(causes);
    json["found"] = defect_list(run.found);
    return dump(Json{{"runs", Json::array({std::move(json)})}});
}

std::string trend_json(const ReportedTrend& r) {
    Json points = Json::array();
    for (const TrendPoint& p : r.trend->points) {
        Json point{{"id", p.run}, {"time", p.time}, {"value", number(p.value)}};
        if (!r.by.empty()) point["by"] = known_text(p.group);
        points.push_back(std::move(point));
    }
    Json change = nullptr;
    if (r.trend->change) {
        const TrendChange& c = *r.trend->change;
        const TrendPoint& since = r.trend->points[c.first];
        change = {{"id", since.run},
                  {"time", since.time},
                  {"before", number(c.before)},
                  {"after", number(c.after)},
                  {"p", number(c.p)}};
    }
    Json groups = Json::array();
    for (const TrendGroup& g : r.trend->groups)
        groups.push_back({{"value", known_text(g.name)},
                          {"runs", g.runs},
                          {"median", number(g.median)},
                          {"highest", number(g.most)}});
    return dump(Json{{"quantity", r.quantity->name},
                     {"unit", r.quantity->unit},
                     {"filter", filter_object(r.filter)},
                     {"by", known_text(r.by)},
                     {"points", std::move(points)},
                     {"change", std::move(change)},
                     {"groups", std::move(groups)}});
}

std::string outliers_json(std::span<const RunRecord> runs, std::span<const RunOutlier> outliers) {
    Json all = Json::array();
    for (const RunOutlier& o : outliers)
        all.push_back({{"id", runs[o.run].id},
                       {"time", runs[o.run].time},
                       {"quantity", o.quantity->name},
                       {"unit", o.quantity->unit},
                       {"value", number(o.value)},
                       {"usual", number(o.usual)},
                       {"score", number(o.z, 2)}});
    return dump(Json{{"outliers", std::move(all)}, {"runs", runs.size()}});
}

std::string comparison_json(const RunRecord& reference, const RunRecord& run, const RunComparison& c) {
    Json quantities = Json::array();
    for (const QuantityChange& q : c.quantities)
        quantities.push_back({{"name", q.quantity->name},
                              {"unit", q.quantity->unit},
                              {"before", number(q.before)},
                              {"after", number(q.after)}});
    Json defects = Json::array();
    for (std::size_t i = 0; i < run.found.size(); ++i) {
        defects.push_back({{"state", name_of(c.match.states[i])}});
        defects.back().update(defect_object(run.found[i]));
    }
    Json gone = Json::array();
    for (const std::size_t k : c.match.gone) gone.push_back(defect_object(reference.found[k]));
    return dump(Json{{"reference", run_object(reference)},
                     {"run", run_object(run)},
                     {"quantities", std::move(quantities)},
                     {"found", std::move(defects)},
                     {"gone", std::move(gone)}});
}

}  // namespace clsurf::io
