#pragma once
// The names of fields, for help and completion.

#include <vector>

#include "field/field.h"

namespace clsurf::cli {

/// The fields that do not depend on a log's channels.
[[nodiscard]] std::vector<FieldInfo> known_fields();

}  // namespace clsurf::cli
