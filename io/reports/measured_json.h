#pragma once
// An alignment and a comparison with a measurement as JSON. Used inside io only.

#include "io/files/json_value.h"
#include "io/reports/reported_measurement.h"

namespace clsurf::io {

/// Keys as in alignment_json(), without tool and diagnostics.
[[nodiscard]] Json alignment_keys(const MeasuredData& data, const Alignment& alignment);
/// The key `measured` of a report; its keys: docs/howto/measured.md.
[[nodiscard]] Json measured_json(const ReportedMeasurement& measured);

}  // namespace clsurf::io
