#pragma once
// Values as JSON, the same in every report: what is not finite is null, invalid UTF-8 is U+FFFD.
// Used inside io only.

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/cutter_place.h"
#include "core/diagnostic.h"
#include "core/geometry.h"

namespace clsurf::io {

using Json = nlohmann::ordered_json;

/// Grows when a key changes its meaning; new keys do not change it.
constexpr int schema_version = 2;

/// A report of ours: `schema_version` first, two blanks a level, an end of line.
[[nodiscard]] std::string dump(const Json& report);
/// The same of a format that others define, without our version.
[[nodiscard]] std::string dump_foreign(const Json& json);

/// On one line, without blanks.
[[nodiscard]] std::string dump_compact(const Json& json);

/// A text as JSON; is_discarded() where it is malformed, nested deeper than 64 levels (writing and
/// destroying values goes down their levels on the stack) or has an object with more than 10,000 keys (each
/// is looked for among those before it).
[[nodiscard]] Json parse_bounded(std::string_view text);

/// JSON has no NaN and no infinity.
[[nodiscard]] Json number(double value);

/// The same with so many decimals: as many as mean something. Never -0.
[[nodiscard]] Json number(double value, int decimals);

/// A place [mm], to a hundredth of a micrometre.
[[nodiscard]] Json vector(const Vec3& v);
/// All digits: directions, and what other numbers are counted from.
[[nodiscard]] Json exact_vector(const Vec3& v);

[[nodiscard]] Json box(const Box3& b);

/// Adds "position_mm" (the contact point where it is known, else the tip), "tip_mm" and, where it is known,
/// "contact_mm" to an object.
void add_place(Json& json, const CutterPlace& place);

[[nodiscard]] Json list(const Diagnostics& diagnostics);

}  // namespace clsurf::io
