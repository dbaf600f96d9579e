#include "io/defect_json.h"

#include "core/units.h"

namespace clsurf::io {
namespace {

/// "passes", "lines" and "points" of runs, side by side.
void add_runs(Json& json, const std::vector<DefectRun>& runs) {
    Json passes = Json::array();
    Json lines = Json::array();
    Json points = Json::array();
    for (const DefectRun& run : runs) {
        passes.push_back(run.pass);
        lines.push_back(Json::array({run.first_line, run.last_line}));
        points.push_back(Json::array({run.points.first, run.points.last}));
    }
    json["passes"] = std::move(passes);
    json["lines"] = std::move(lines);
    json["points"] = std::move(points);
}

Json defect_json(const Defect& d, std::size_t id, double scallop) {
    Json json{{"id", id},
              {"rank", id},
              {"severity", d.severity},
              {"cause", name_of(d.cause)},
              {"quantity", name_of(d.quantity)},
              {"systematic", d.systematic},
              {"position_mm", vector(d.position)},
              {"bounds_mm", box(d.bounds)},
              {"area_mm2", number(d.area)},
              {"length_mm", number(d.length)},
              {"depth_um", number(d.depth * um_per_mm)},
              {"depth_scallops", scallop > 0 ? number(d.depth / scallop) : Json(nullptr)},
              {"shape", d.pit ? "pit" : "bulge"},
              {"speed_jump_mm_min", number(d.speed_jump * seconds_per_minute)},
              {"speed_jump_percent", number(100 * d.speed_mismatch)},
              {"acceleration_jump_mm_s2", number(d.acceleration_jump)},
              {"score", number(d.score)},
              {"point", d.point}};
    add_runs(json, d.runs);
    Json beside;
    add_runs(beside, d.neighbours);
    json["neighbours"] = std::move(beside);
    return json;
}

}  // namespace

Json list_defects(const std::vector<Defect>& defects, double scallop) {
    Json all = Json::array();
    for (const Defect& defect : defects) all.push_back(defect_json(defect, all.size() + 1, scallop));
    return all;
}

}  // namespace clsurf::io
