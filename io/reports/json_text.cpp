#include "io/reports/json_text.h"

#include "core/units.h"
#include "io/files/json_value.h"
#include "io/formats/run_parameters.h"

namespace clsurf::io {
namespace {

Json place_json(const ProgramPlace& place) {
    return {{"file", place.file}, {"line", place.line}, {"text", place.text}};
}

}  // namespace

std::string program_json(const Program& program, const ToolpathSummary& s, const Diagnostics& diagnostics) {
    Json json{{"kind", "program"},
              {"file", program.main().name()},
              {"dialect", program.dialect->name},
              {"lines", program.main().line_count()},
              {"motions",
               {{"rapid", s.rapids}, {"feed", s.feeds}, {"arc", s.arcs}, {"spline", s.splines}, {"dwell", s.dwells}}},
              {"cutting_length_mm", number(s.cutting_length)}};
    if (!program.dialect_guessed_from.empty()) json["dialect_guessed_from"] = program.dialect_guessed_from;
    json["bounds_mm"] = box(s.bounds);
    json["diagnostics"] = list(diagnostics);
    return dump(json);
}

std::string log_json(const Log& log, const LogVerdict& verdict, const Diagnostics& diagnostics) {
    Json channels = Json::array();
    for (const Channel& c : log.channels) channels.push_back({{"name", c.name}, {"unit", c.unit}});
    Json json{{"kind", "log"},
              {"file", log.name},
              {"ok", verdict.ok},
              {"verdict", verdict.text},
              {"format", log.format},
              {"records", log.records},
              {"period_s", number(log.period)},
              {"duration_s", number(log.records > 0 ? log.time_of(log.records - 1) : 0.0)},
              {"channels", std::move(channels)},
              {"closed", log.closed}};
    if (const std::vector<RunParameter> parameters = parameters_of_metadata(log.metadata); !parameters.empty()) {
        json["parameters"] = Json::object();
        for (const RunParameter& parameter : parameters) json["parameters"][parameter.name] = parameter.value;
    }
    json["diagnostics"] = list(diagnostics);
    return dump(json);
}

std::string query_json(const std::vector<QueryMatch>& matches, const Diagnostics& diagnostics) {
    Json all = Json::array();
    for (const QueryMatch& m : matches) {
        Json calls = Json::array();
        for (const ProgramPlace& call : m.calls.calls) calls.push_back(place_json(call));
        all.push_back({{"point", m.point},
                       {"time_s", number(m.time, 6)},
                       {"line", m.line},
                       {"text", m.text},
                       {"subprogram", m.calls.subprogram ? place_json(*m.calls.subprogram) : Json()},
                       {"calls", std::move(calls)},
                       {"speed_mm_min", number(m.speed * seconds_per_minute, 2)},
                       {"acceleration_mm_s2", number(m.acceleration, 2)},
                       {"confidence", number(m.confidence, 3)},
                       {"distance_mm", number(m.distance, 4)},
                       {"line_points", Json::array({m.line_points.first, m.line_points.last})}});
        add_place(all.back(), m.place);
        if (m.pass) all.back()["pass"] = *m.pass;
        if (m.why.programmed_feed > 0) {
            all.back()["feed_mm_min"] = number(m.why.programmed_feed * seconds_per_minute, 2);
            all.back()["slow_because"] = m.why.reasons;
        }
        if (m.speed_uncertainty)
            all.back()["speed_uncertainty_mm_min"] = number(*m.speed_uncertainty * seconds_per_minute);
        if (m.acceleration_uncertainty)
            all.back()["acceleration_uncertainty_mm_s2"] = number(*m.acceleration_uncertainty);
        if (!m.estimated_from.empty()) all.back()["estimated_from"] = m.estimated_from;
        if (!m.fused) continue;
        const auto three = [](const Vec3& v, int digits) {
            return Json::array({number(v.x(), digits), number(v.y(), digits), number(v.z(), digits)});
        };
        all.back()["table_mm"] = three(m.fused->position, 6);
        all.back()["table_uncertainty_um"] = three(m.fused->uncertainty * um_per_mm, 4);
    }
    return dump(Json{{"matches", std::move(all)}, {"diagnostics", list(diagnostics)}});
}

std::string comparison_json(const ComparisonReport& r) {
    return dump(Json{{"equal", r.equal},
                     {"max_error", number(r.max_error)},
                     {"mean_error", number(r.mean_error)},
                     {"psnr", number(r.psnr)},
                     {"delta_e", number(r.delta_e)},
                     {"pixels_over", r.pixels_over},
                     {"threshold", number(r.threshold)}});
}

std::string table_json(const std::string& file, const ForeignTable& table) {
    return dump(Json{{"kind", "table"},
                     {"file", file},
                     {"columns", table.titles},
                     {"suggested_mapping", suggest_mapping(table, file)}});
}

std::string list_json(const std::string& list, const std::vector<std::string>& reports) {
    Json all = Json::array();
    for (const std::string& text : reports) {
        all.push_back(Json::parse(text));
        all.back().erase("schema_version");  // given once, for the whole
    }
    Json json = all.size() == 1 ? all.front() : Json::object();
    json[list] = std::move(all);
    return dump(json);
}

}  // namespace clsurf::io
