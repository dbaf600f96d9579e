#pragma once
// The card of one defect, for `plot --defect` and for reports.

#include <string>

#include "cli/options/part.h"
#include "machined/as_machined_report.h"
#include "predictor/defect.h"
#include "surface/cl_surface.h"
#include "viz/image.h"

namespace clsurf::cli {

/// A part with its report.
struct JudgedPart {
    const Part& part;
    const ClSurface& surface;
    const Signals& signals;
    const QualityReport& report;
    const AsMachinedReport* as_machined =
        nullptr;  ///< marks of the report's defects; nullptr: the card has no formed value
};

/// The card of a defect of the report, from 0; `keep_drawing`: for SVG and PDF. Throws SystemError.
[[nodiscard]] viz::Image draw_defect_card(const JudgedPart& judged, std::size_t index, int width, int height,
                                          const std::string& gl, bool keep_drawing = false);

/// `plot --defect N`: finds the defects as `check` does and draws the card of one. Throws UsageError: there is no such defect.
[[nodiscard]] ExitCode plot_defect(const po::variables_map& values, const PartOptions& options, long long number,
                                   const std::string& output, int width, int height, const std::string& gl);

}  // namespace clsurf::cli
