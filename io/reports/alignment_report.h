#pragma once
// The alignment of a measurement with the predicted surface, as text and JSON.

#include <string>

#include "core/diagnostic.h"
#include "machined/tool.h"
#include "measured/align.h"
#include "measured/measured_data.h"

namespace clsurf::io {

[[nodiscard]] std::string alignment_text(const MeasuredData& data, const Alignment& alignment);
/// Keys: file, kind, points, used, left_out, missing, determined, reasons[], rms_um, worst_um, correlated_points, pose{x_mm,
/// y_mm, z_mm, a_deg, b_deg, c_deg}, matrix[4][4], parameters[]{name, value, unit, standard_error, fitted}, tool, diagnostics[].
[[nodiscard]] std::string alignment_json(const MeasuredData& data, const Alignment& alignment, const CuttingTool& tool,
                                         const Diagnostics& diagnostics);

}  // namespace clsurf::io
