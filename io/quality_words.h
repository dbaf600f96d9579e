#pragma once
// The words in which reports speak of findings: the same in the text, in SARIF and on the page. Used inside io only.

#include <string>

#include "quality/defects.h"

namespace clsurf::io {

/// "speed 3.0 %, acceleration 120 mm/s², …" of the thresholds that are known; empty: none is.
[[nodiscard]] std::string thresholds_text(const QualityReport& report);

}  // namespace clsurf::io
