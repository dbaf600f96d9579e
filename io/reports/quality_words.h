#pragma once
// The words in which reports speak of defects: the same in the text, in SARIF and on the page. Used inside io only.
//
// One convention for all of them: a speed below that of the neighbours is negative, in mm/min and in percent of the neighbours'
// speed. Depths have no sign; the shape says whether the pass lies below its neighbours (pit) or above them (bulge).

#include <string>
#include <string_view>

#include "machined/as_machined_report.h"
#include "predictor/defects.h"

namespace clsurf::io {

/// What the coordinates of a place are of: "contact", "tool tip".
[[nodiscard]] std::string_view place_word(const CutterPlace& place);
/// "X 1.00 Y 2.00 Z 3.00".
[[nodiscard]] std::string axes_text(const Vec3& at, int decimals = 2);
/// "1.00 2.00 3.00", for columns.
[[nodiscard]] std::string coordinates_text(const Vec3& at);
/// "tool tip X 1.00 Y 2.00 Z 3.00 mm".
[[nodiscard]] std::string place_text(const CutterPlace& place);

/// "pit", "bulge", "alternating", or "none" where the depth is below 0.05 µm.
[[nodiscard]] std::string_view shape_of(const Defect& defect);
/// The same of its values. `depth` [mm].
[[nodiscard]] std::string_view shape_of(bool systematic, double depth, bool pit);
/// "8.0 µm bulge", or "0.0 µm". `unit`: what follows the number.
[[nodiscard]] std::string depth_text(const Defect& defect, std::string_view unit = " µm");

/// What is wrong, as a sentence without its full stop: "Pass 14 runs 82 % slower than its neighbours over 3.4 mm".
[[nodiscard]] std::string sentence_of(const Defect& defect);

/// Why a defect has no depth in the as-machined surface, or another one than its pass alone, without full stop; none: "".
[[nodiscard]] std::string_view sentence_of(MarkNote note);

/// What was found in one sentence, what stands out most first, and "No defects …" or "Not judged …" where that is so.
[[nodiscard]] std::string verdict_of(const QualityReport& report);

/// "speed 3.0 %, acceleration 120 mm/s², …" of the thresholds that are known; empty: none is.
[[nodiscard]] std::string thresholds_text(const QualityReport& report);

/// What a kind of defect is and what helps, for the help of a rule.
struct RuleText {
    std::string_view id;    ///< "feed_drop"
    std::string_view what;  ///< a sentence
    std::string_view help;  ///< sentences
};
[[nodiscard]] const RuleText& rule_of(const Defect& defect);

}  // namespace clsurf::io
