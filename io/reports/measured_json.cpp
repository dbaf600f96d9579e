#include "io/reports/measured_json.h"

#include <string>

#include "core/units.h"

namespace clsurf::io {
namespace {

double mm_as_um(double mm) { return mm * um_per_mm; }

Json parameters_json(const Alignment& alignment) {
    Json all = Json::array();
    for (const PoseParameter& p : alignment.parameters) {
        const bool rotation = p.axis >= PoseAxis::a;
        const double factor = rotation ? deg_per_rad : 1;
        all.push_back({{"name", std::string(name_of(p.axis))},
                       {"value", number(p.value * factor, 6)},
                       {"unit", rotation ? "deg" : "mm"},
                       {"standard_error", p.fitted ? number(p.standard_error * factor, 7) : Json(nullptr)},
                       {"fitted", p.fitted}});
    }
    return all;
}

Json roughness_json(const Roughness& r) {
    return {{"ra_um", number(mm_as_um(r.ra), 4)},
            {"rq_um", number(mm_as_um(r.rq), 4)},
            {"rz_um", number(mm_as_um(r.rz), 4)}};
}

Json marks_json(const ReportedMeasurement& measured, MarkState state) {
    Json all = Json::array();
    for (const ComparedMark& mark : measured.result.marks) {
        if (mark.state != state) continue;
        Json json{{"id", mark.defect + 1}, {"shape", mark.pit ? "pit" : "bulge"}, {"position_mm", vector(mark.place)}};
        json["along_mm"] = measured.data.kind == MeasuredKind::profile ? number(mark.along, 4) : Json(nullptr);
        if (state == MarkState::not_judged) {
            json["reason"] = mark.reason;
        } else {
            json["predicted_um"] = number(mm_as_um(mark.predicted), 3);
            json["measured_um"] = number(mm_as_um(mark.measured), 3);
        }
        all.push_back(std::move(json));
    }
    return all;
}

}  // namespace

Json alignment_keys(const MeasuredData& data, const Alignment& alignment) {
    Json json{{"file", data.name},
              {"kind", std::string(name_of(data.kind))},
              {"points", alignment.points},
              {"used", alignment.used},
              {"left_out", alignment.left_out},
              {"missing", data.missing},
              {"determined", alignment.determined()},
              {"reasons", alignment.reasons}};
    if (alignment.parameters.empty()) return json;
    const Vec3 turns = turns_of(alignment.pose.turn) * deg_per_rad;
    const Vec3& shift = alignment.pose.shift;
    json["rms_um"] = number(mm_as_um(alignment.rms), 3);
    json["scatter_um"] = alignment.scatter > 0 ? number(mm_as_um(alignment.scatter), 3) : Json(nullptr);
    json["worst_um"] = number(mm_as_um(alignment.worst), 3);
    json["correlated_points"] = number(alignment.correlated, 1);
    json["pose"] = {{"x_mm", number(shift.x(), 5)},  {"y_mm", number(shift.y(), 5)},  {"z_mm", number(shift.z(), 5)},
                    {"a_deg", number(turns.x(), 6)}, {"b_deg", number(turns.y(), 6)}, {"c_deg", number(turns.z(), 6)}};
    Json matrix = Json::array();
    for (Eigen::Index row = 0; row < 3; ++row) {
        matrix.push_back({number(alignment.pose.turn(row, 0)), number(alignment.pose.turn(row, 1)),
                          number(alignment.pose.turn(row, 2)), number(shift[row])});
    }
    matrix.push_back({0, 0, 0, 1});
    json["matrix"] = std::move(matrix);
    json["parameters"] = parameters_json(alignment);
    return json;
}

Json measured_json(const ReportedMeasurement& measured) {
    const MeasuredComparison& c = measured.result.comparison;
    const bool compared = c.reason.empty();
    Json json{{"file", measured.data.name},
              {"kind", std::string(name_of(measured.data.kind))},
              {"compared", compared},
              {"reason", compared ? Json(nullptr) : Json(c.reason)}};
    if (compared) {
        json.update(roughness_json(c.measured));
        json["predicted"] = roughness_json(c.predicted);
        json["difference"] = {{"ra_um", number(mm_as_um(c.measured.ra - c.predicted.ra), 4)},
                              {"rq_um", number(mm_as_um(c.measured.rq - c.predicted.rq), 4)},
                              {"rz_um", number(mm_as_um(c.measured.rz - c.predicted.rz), 4)}};
        json["correlation"] = number(c.correlation, 4);
        json["scatter_um"] = number(mm_as_um(c.noise), 4);
        json["profiles"] = c.profiles.size();
        json["evaluated_mm"] = number(c.measured.length, 4);
        json["sampling_lengths"] = c.measured.sampling_lengths;
        json["cutoff_mm"] = number(c.measured.cutoff);
        json["short_cutoff_um"] = c.short_cutoff > 0 ? number(mm_as_um(c.short_cutoff), 3) : Json(nullptr);
    }
    json["marks_found"] = marks_json(measured, MarkState::found);
    json["marks_missing"] = marks_json(measured, MarkState::missing);
    json["marks_not_judged"] = marks_json(measured, MarkState::not_judged);
    json["alignment"] = alignment_keys(measured.data, measured.result.alignment);
    return json;
}

}  // namespace clsurf::io
