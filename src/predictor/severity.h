#pragma once
// Severity: what a defect means to the person who inspects the part, from its depth and its score.

#include <array>
#include <string_view>

namespace clsurf {

inline constexpr int severities = 4;

/// "trace", "visible", "distinct", "reject"; domain 1 … 4.
[[nodiscard]] std::string_view name_of_severity(int severity);
/// "in the data only: at the edge of what can be measured" …
[[nodiscard]] std::string_view meaning_of_severity(int severity);

struct SeverityRule {
    std::array<double, 3> depth{0.002, 0.005, 0.020};  ///< [mm] where 2, 3, 4 begin …
    std::array<float, 3> stands_out{1, 1.5F, 6};       ///< … for a score of so much at least
    std::array<float, 2> motion{2, 15};                ///< score of a motion where 2, 3 begin, whatever the depth
    int most_systematic = 3;  ///< what all passes share is a machine to be tuned, no part to be rejected
};

/// What severity is made from.
struct SeverityEvidence {
    double depth = 0;         ///< [mm] ≥ 0
    float score = 0;          ///< over its threshold
    bool motion = false;      ///< a difference of speed or acceleration
    bool systematic = false;  ///< alternates over a large part of the surface
};
[[nodiscard]] int severity_of(const SeverityEvidence& evidence, const SeverityRule& rule);

}  // namespace clsurf
