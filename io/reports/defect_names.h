#pragma once
// The short words for defects on a picture: its title, and one label for each.

#include <string>

#include "predictor/defect.h"

namespace clsurf::io {

/// The strongest finding in one line, with all defects of its kind that are at least half as strong: "Five passes run 82 to
/// 87 % slower than their neighbours". "No defects" or "Not judged" where that is so.
[[nodiscard]] std::string headline_of(const QualityReport& report);

/// "−87 % speed", "+12 µm lag", "±67 µm lag": by the quantity that shows it best.
[[nodiscard]] std::string label_of(const Defect& defect);

/// Where it is strongest: "X 1.5  Y −4.7  Z 4.9", the contact point where the tool is known, else the tool tip.
[[nodiscard]] std::string place_label(const Defect& defect);

/// Cause and predicted depth: "point spacing, 1.2 µm deep".
[[nodiscard]] std::string cause_label(const Defect& defect);

/// The lines of its strongest section, as sections_lines() has them: "lines 506–669", "line 12, 4 sections".
[[nodiscard]] std::string lines_label(const Defect& defect);

}  // namespace clsurf::io
