#pragma once
// Short texts for defects in a picture: its title, and one label each.

#include <string>

#include "predictor/defect.h"

namespace clsurf::io {

/// The strongest finding in one line, with all defects of its kind that are at least half as strong: "Five passes run 82 to
/// 87 % slower than their neighbours". "No defects" or "Not judged" if that is the result.
[[nodiscard]] std::string headline_of(const QualityReport& report);

/// "−87 % speed", "+12 µm lag", "±67 µm lag": the quantity that shows the defect best.
[[nodiscard]] std::string label_of(const Defect& defect);

/// The strongest place: "X 1.5  Y −4.7  Z 4.9", the contact point if the tool is known, otherwise the tool tip.
[[nodiscard]] std::string place_label(const Defect& defect);

/// Cause and predicted depth: "point spacing, 1.2 µm deep".
[[nodiscard]] std::string cause_label(const Defect& defect);

/// The lines of the strongest section, as in sections_lines(): "lines 506–669", "line 12, 4 sections".
[[nodiscard]] std::string lines_label(const Defect& defect);

}  // namespace clsurf::io
