#pragma once
// Recorded runs in JSON: the same keys in every answer of a history. Used inside io only.

#include "history/run_record.h"
#include "io/files/json_value.h"

namespace clsurf::io {

/// A run without its defects.
[[nodiscard]] Json run_object(const RunRecord& run);
[[nodiscard]] Json defect_object(const RecordedDefect& defect);

}  // namespace clsurf::io
