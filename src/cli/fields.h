#pragma once
// The fields that subcommands offer.

#include <vector>

#include "field/field_set.h"
#include "pipeline/part.h"

namespace clsurf::cli {

/// Those of a part and its surface, which must outlive it.
[[nodiscard]] FieldSet all_fields_of(const Part& part, const ClSurface& surface);

/// Those that do not depend on a log's channels, for help and completion.
[[nodiscard]] std::vector<FieldInfo> known_fields();

}  // namespace clsurf::cli
