#pragma once
// Values as JSON, the same in every report: numbers that are not finite become null, invalid UTF-8 becomes U+FFFD.
// Used inside io only.

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/cutter_place.h"
#include "core/diagnostic.h"
#include "core/geometry.h"

namespace clsurf::io {

using Json = nlohmann::ordered_json;

/// Incremented if a key changes its meaning; new keys do not change it.
constexpr int schema_version = 2;

/// A report of clsurf: `schema_version` first, indented by two blanks, with a final line end.
[[nodiscard]] std::string dump(const Json& report);
/// The same for a format that others define, without the version.
[[nodiscard]] std::string dump_foreign(const Json& json);

/// On one line, without blanks.
[[nodiscard]] std::string dump_compact(const Json& json);

/// Parses JSON. Returns a discarded value (is_discarded()) if the text is malformed, nested deeper than 64 levels (values
/// are written and destroyed recursively), or has an object with more than 10,000 keys (each key is compared with
/// all earlier ones).
[[nodiscard]] Json parse_bounded(std::string_view text);

/// NaN and infinity become null: JSON does not have them.
[[nodiscard]] Json number(double value);

/// The same with a fixed number of decimals, as many as are significant. Never -0.
[[nodiscard]] Json number(double value, int decimals);

/// A position [mm], rounded to 0.01 µm.
[[nodiscard]] Json vector(const Vec3& v);
/// All digits: for directions and for the origin of other numbers.
[[nodiscard]] Json exact_vector(const Vec3& v);

[[nodiscard]] Json box(const Box3& b);

/// Adds "position_mm" (the contact point if it is known, otherwise the tip), "tip_mm" and, if it is known,
/// "contact_mm" to an object.
void add_place(Json& json, const CutterPlace& place);

[[nodiscard]] Json list(const Diagnostics& diagnostics);

}  // namespace clsurf::io
