#pragma once
// The result of a scan: the points, the fit, and the program of `profile`, as text and JSON.

#include <optional>
#include <string>

#include "core/diagnostic.h"
#include "scan/compensate.h"
#include "scan/read_back.h"
#include "scan/scan_cut.h"

namespace clsurf::io {

/// A finished pass that was corrected.
struct CorrectedPass {
    std::string program;
    Compensation by;
};

/// The run of the written program on a simulated machine.
struct SimulatedCut {
    std::string machine;
    double deviation = 0;  ///< [mm] largest distance between the commanded path and the fit
    double allowed = 0;    ///< [mm] tolerances of the program and of the machine's corners
    double duration = 0;   ///< [s] time with approach and retract
};

struct CutReport {
    std::string scan, output, dialect;
    std::size_t read = 0;     ///< points
    std::size_t missing = 0;  ///< points without a height
    ScanCutRules rules;
    ReadBack written;
    SimulatedCut simulated;
    bool splines = false;
    std::optional<CorrectedPass> corrected;  ///< the scan then has deviations
};

/// The points of the fit, and its residuals.
struct ScanResiduals {
    const CleanScan& scan;
    const FitResiduals& residuals;
};

/// The residuals of the scan. If a pass was corrected, those of the deviations: `cut` is then the target profile.
[[nodiscard]] ScanResiduals residuals_of(const CutReport& report, const ScanCut& cut);

[[nodiscard]] std::string cut_text(const CutReport& report, const ScanCut& cut);
/// Keys: file, output, dialect, points, missing, rejected, rejected_mm[][x, z], averaged, scatter_mm, outliers, degree,
/// window, join, pieces, x_mm[2], rms_residual_mm, max_residual_mm, max_residual_at_mm, window_jumps{count, rms_mm, max_mm,
/// max_at_mm, max_slope}, tool_offset_mm, blocks, output_points, tolerance_mm, chord_error_mm,
/// simulation{machine, deviation_mm, allowed_mm, time_s}, diagnostics[]. Of a
/// corrected pass also compensation{program, max_mm, max_at_mm, scatter_mm, rejected_mm[][x, deviation]}; all keys but points
/// and missing are then of the corrected profile. chord_error_mm is of the written program, read again.
[[nodiscard]] std::string cut_json(const CutReport& report, const ScanCut& cut, const Diagnostics& diagnostics);

[[nodiscard]] std::string_view name_of(WindowJoin join);

}  // namespace clsurf::io
