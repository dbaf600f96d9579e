#pragma once
// ReportedMeasurement: a measurement with its results.

#include "measured/measured_data.h"
#include "measured/measured_result.h"

namespace clsurf::io {

struct ReportedMeasurement {
    MeasuredData data;
    MeasuredResult result;
};

}  // namespace clsurf::io
