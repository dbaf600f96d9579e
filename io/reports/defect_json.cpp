#include "io/reports/defect_json.h"

#include <string>

#include "core/units.h"
#include "io/reports/quality_words.h"

namespace clsurf::io {
namespace {

/// "passes", "lines" and "points" of sections as parallel arrays, and "subprograms" if a section is in another file.
void add_sections(Json& json, const std::vector<DefectSection>& sections) {
    Json passes = Json::array();
    Json lines = Json::array();
    Json points = Json::array();
    Json subprograms = Json::array();
    bool in_subprogram = false;
    for (const DefectSection& section : sections) {
        passes.push_back(section.pass);
        lines.push_back(Json::array({section.first_line, section.last_line}));
        points.push_back(Json::array({section.points.first, section.points.last}));
        in_subprogram = in_subprogram || !section.file.empty();
        subprograms.push_back(section.file.empty()
                                  ? Json(nullptr)
                                  : Json{{"file", section.file},
                                         {"lines", Json::array({section.file_first_line, section.file_last_line})}});
    }
    json["passes"] = std::move(passes);
    json["lines"] = std::move(lines);
    json["points"] = std::move(points);
    if (in_subprogram) json["subprograms"] = std::move(subprograms);
}

/// The additional keys of a systematic lag.
void add_systematic(Json& json, const Defect& d) {
    constexpr double ms_per_s = 1e3;
    json["share_percent"] = number(100 * d.share, 1);
    Json axes = Json::array();
    for (const AxisDelay& a : d.delays)
        axes.push_back({{"axis", std::string(1, a.axis)}, {"delay_ms", number(ms_per_s * a.delay, 3)}});
    json["axes"] = std::move(axes);
}

Json defect_json(const Defect& d, std::size_t id, double scallop) {
    Json json{{"id", id},
              {"rank", id},
              {"score", number(static_cast<double>(d.score), 2)},
              {"severity", d.severity},
              {"cause", name_of(d.cause)},
              {"quantity", name_of(d.quantity)},
              {"systematic", d.systematic},
              {"text", sentence_of(d)},
              {"bounds_mm", box(d.contact_bounds.isEmpty() ? d.bounds : d.contact_bounds)},
              {"area_mm2", number(d.area, 4)},
              {"length_mm", number(d.length, 3)},
              {"depth_um", number(d.depth * um_per_mm, 2)},
              {"depth_scallops", scallop > 0 ? number(d.depth / scallop, 2) : Json(nullptr)},
              {"shape", shape_of(d)},
              {"speed_jump_mm_min", number(d.speed_jump * seconds_per_minute, 1)},
              {"speed_jump_percent", number(100 * d.speed_mismatch, 1)},
              {"acceleration_jump_mm_s2", number(d.acceleration_jump, 1)},
              {"point", d.point}};
    if (d.systematic) add_systematic(json, d);
    add_place(json, d.place);
    add_sections(json, d.sections);
    Json beside;
    add_sections(beside, d.neighbours);
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
