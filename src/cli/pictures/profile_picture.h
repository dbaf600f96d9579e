#pragma once
// The picture of `profile`: the fit over the scanned points, and the residuals.

#include "cli/pictures/picture_output.h"
#include "io/reports/cut_report.h"

namespace clsurf::cli {

void draw_fit(const io::CutReport& report, const ScanCut& cut, PictureOutput& output);

}  // namespace clsurf::cli
