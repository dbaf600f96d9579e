#pragma once
// The wording of reports about defects: the same in the text, in SARIF and on the page. Used inside io only.
//
// One convention for all of them: a speed below that of the neighbours is negative, in mm/min and in percent of the
// neighbours' speed. Depths have no sign; the shape says whether the pass is below its neighbours (pit) or above them
// (bulge).

#include <string>
#include <string_view>

#include "machined/as_machined_report.h"
#include "predictor/defects.h"

namespace clsurf::io {

/// The point whose coordinates are given: "contact", "tool tip".
[[nodiscard]] std::string_view place_word(const CutterPlace& place);
/// "X 1.00 Y 2.00 Z 3.00".
[[nodiscard]] std::string axes_text(const Vec3& at, int decimals = 2);
/// "1.00 2.00 3.00", for columns.
[[nodiscard]] std::string coordinates_text(const Vec3& at);
/// "tool tip X 1.00 Y 2.00 Z 3.00 mm".
[[nodiscard]] std::string place_text(const CutterPlace& place);

/// "pit", "bulge", "alternating", or "none" if the depth is below 0.05 µm.
[[nodiscard]] std::string_view shape_of(const Defect& defect);
/// The same from values. `depth` [mm].
[[nodiscard]] std::string_view shape_of(bool systematic, double depth, bool pit);
/// "8.0 µm bulge", or "0.0 µm". `unit`: the text after the number.
[[nodiscard]] std::string depth_text(const Defect& defect, std::string_view unit = " µm");

/// A sentence without its full stop: "Pass 14 runs 82 % slower than its neighbours over 3.4 mm".
[[nodiscard]] std::string sentence_of(const Defect& defect);

/// Why the depth of a defect in the as-machined surface is missing or differs from that of its pass alone, without full
/// stop; none: "".
[[nodiscard]] std::string_view sentence_of(MarkNote note);

/// The result in one sentence, the most conspicuous kind first; "No defects …" or "Not judged …" if that is the result.
[[nodiscard]] std::string verdict_of(const QualityReport& report);

/// "speed 3.0 %, acceleration 120 mm/s², …" of the known thresholds; empty: none is known.
[[nodiscard]] std::string thresholds_text(const QualityReport& report);

/// A kind of defect and its remedy, for the help of a rule.
struct RuleText {
    std::string_view id;    ///< "feed_drop"
    std::string_view what;  ///< a sentence
    std::string_view help;  ///< sentences
};
[[nodiscard]] const RuleText& rule_of(const Defect& defect);

}  // namespace clsurf::io
