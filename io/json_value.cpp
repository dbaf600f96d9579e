#include "io/json_value.h"

#include <cmath>

namespace clsurf::io {

std::string dump(const Json& report) {
    Json versioned{{"schema_version", schema_version}};
    versioned.update(report);
    return dump_foreign(versioned);
}

std::string dump_foreign(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

std::string dump_compact(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json parse_bounded(std::string_view text) {
    constexpr int most_levels = 64, most_keys = 10'000;
    bool beyond = false;
    int keys = 0;
    Json value = Json::parse(
        text,
        [&](int level, Json::parse_event_t event, const Json&) {
            if (event == Json::parse_event_t::key) ++keys;
            beyond = beyond || level > most_levels || keys > most_keys;
            return !beyond;
        },
        false);
    return beyond ? Json(Json::value_t::discarded) : value;
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json number(double value, int decimals) {
    const double scale = std::pow(10.0, decimals);
    const double rounded = std::round(value * scale) / scale;
    return number(std::isfinite(rounded) ? rounded + 0.0 : value);
}

Json vector(const Vec3& v) {
    constexpr int decimals = 5;
    return Json::array({number(v.x(), decimals), number(v.y(), decimals), number(v.z(), decimals)});
}

Json exact_vector(const Vec3& v) { return Json::array({number(v.x()), number(v.y()), number(v.z())}); }

Json box(const Box3& b) { return b.isEmpty() ? Json(nullptr) : Json::array({vector(b.min()), vector(b.max())}); }

void add_place(Json& json, const CutterPlace& place) {
    json["position_mm"] = vector(place.position());
    json["tip_mm"] = vector(place.tip);
    if (place.contact) json["contact_mm"] = vector(*place.contact);
}

Json list(const Diagnostics& diagnostics) {
    Json all = Json::array();
    for (const Diagnostic& d : diagnostics.summary()) {
        Json entry{{"severity", name_of(d.severity)}, {"code", d.code}, {"where", d.where.text()}, {"text", d.text}};
        if (!d.hint.empty()) entry["hint"] = d.hint;
        all.push_back(std::move(entry));
    }
    return all;
}

}  // namespace clsurf::io
