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

/// Chosen on recorded runs: a program without planted unevenness gets no reject
/// (docs/experiments/predictor.md#severities-of-recorded-runs).
struct SeverityRule {
    std::array<double, 3> depth{0.002, 0.005, 0.020};  ///< [mm] least depths for 2, 3, 4 …
    std::array<float, 3> stands_out{1, 1.5F, 6};       ///< … if the score is at least this
    std::array<float, 2> motion{2, 15};                ///< scores from which on a motion is 2 or 3, whatever its depth
    int most_systematic = 3;  ///< a difference of all passes calls for tuning the machine, not for rejecting the part
};

/// The input of the severity.
struct SeverityEvidence {
    double depth = 0;         ///< [mm] ≥ 0
    float score = 0;          ///< peak over threshold
    bool motion = false;      ///< a difference of speed or acceleration
    bool systematic = false;  ///< alternates over a large part of the surface
};
[[nodiscard]] int severity_of(const SeverityEvidence& evidence, const SeverityRule& rule);

}  // namespace clsurf
