#pragma once
// Values as JSON, the same in every report: what is not finite is null, invalid UTF-8 is U+FFFD.
// Used inside io only.

#include <cmath>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/diagnostic.h"
#include "core/geometry.h"

namespace clsurf::io {

using Json = nlohmann::ordered_json;

inline std::string dump(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

/// A text as JSON; is_discarded() where it is malformed or nested deeper than 64 levels: writing and
/// destroying values goes down their levels on the stack.
template <typename Value>
[[nodiscard]] Value parse_bounded(std::string_view text) {
    constexpr int most_levels = 64;
    bool deeper = false;
    Value value = Value::parse(
        text,
        [&](int level, auto, auto&) {
            deeper = deeper || level > most_levels;
            return level <= most_levels;
        },
        false);
    return deeper ? Value(Value::value_t::discarded) : value;
}

/// JSON has no NaN and no infinity.
inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

inline Json vector(const Vec3& v) { return Json::array({number(v.x()), number(v.y()), number(v.z())}); }

inline Json box(const Box3& b) { return b.isEmpty() ? Json(nullptr) : Json::array({vector(b.min()), vector(b.max())}); }

inline Json list(const Diagnostics& diagnostics) {
    Json all = Json::array();
    for (const Diagnostic& d : diagnostics.summary()) {
        Json entry{{"severity", name_of(d.severity)}, {"code", d.code}, {"where", d.where.text()}, {"text", d.text}};
        if (!d.hint.empty()) entry["hint"] = d.hint;
        all.push_back(std::move(entry));
    }
    return all;
}

}  // namespace clsurf::io
