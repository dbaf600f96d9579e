#include "io/files/json_value.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <vector>

namespace clsurf::io {
namespace {

/// The library's Grisu2 sometimes prints more digits than a number needs (-1.2088699999999999). Numbers with
/// sixteen digits or more are therefore written again with the fewest digits that read back as the same value.
std::string with_shortest_numbers(const std::string& json) {
    constexpr std::string_view number_characters = "+-.0123456789eE";
    constexpr std::size_t suspicious = 17;  // characters: sixteen digits and the point
    std::string text;
    text.reserve(json.size());
    for (std::size_t at = 0; at < json.size();) {
        const std::size_t begin = at;
        if (json[at] == '"') {
            for (++at; at < json.size() && json[at] != '"'; ++at) at += json[at] == '\\' ? 1 : 0;
            ++at;
        } else if (json[at] == '-' || (json[at] >= '0' && json[at] <= '9')) {
            at = std::min(json.find_first_not_of(number_characters, at), json.size());
            const bool real = std::memchr(json.data() + begin, '.', at - begin) != nullptr;
            double value = 0;
            if (real && at - begin >= suspicious &&
                std::from_chars(json.data() + begin, json.data() + at, value).ec == std::errc()) {
                char shortest[32];
                text.append(shortest, std::to_chars(shortest, shortest + sizeof shortest, value).ptr);
                continue;
            }
        } else {
            at = std::min(json.find_first_of("\"-0123456789", at), json.size());
        }
        text.append(json, begin, at - begin);
    }
    return text;
}

}  // namespace

std::string dump(const Json& report) {
    Json versioned{{"schema_version", schema_version}};
    versioned.update(report);
    return dump_foreign(versioned);
}

std::string dump_foreign(const Json& json) {
    return with_shortest_numbers(json.dump(2, ' ', false, Json::error_handler_t::replace)) + "\n";
}

std::string dump_compact(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json parse_bounded(std::string_view text) {
    constexpr int most_levels = 64, most_keys = 10'000;
    bool beyond = false;
    std::vector<int> keys;  // number of keys of each open object
    Json value = Json::parse(
        text,
        [&](int level, Json::parse_event_t event, const Json&) {
            if (event == Json::parse_event_t::object_start) keys.push_back(0);
            if (event == Json::parse_event_t::object_end) keys.pop_back();
            beyond = beyond || level > most_levels || (event == Json::parse_event_t::key && ++keys.back() > most_keys);
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
