#pragma once
// The comparison with a measurement as text: a section of the output of `check`.

#include <string>

#include "io/reports/reported_measurement.h"

namespace clsurf::io {

[[nodiscard]] std::string measured_text(const ReportedMeasurement& measured);

}  // namespace clsurf::io
