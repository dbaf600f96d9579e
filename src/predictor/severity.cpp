#include "predictor/severity.h"

#include <algorithm>

namespace clsurf {

std::string_view name_of_severity(int severity) {
    constexpr std::array<std::string_view, severities> names{"trace", "visible", "distinct", "reject"};
    return names.at(static_cast<std::size_t>(severity - 1));
}

std::string_view meaning_of_severity(int severity) {
    constexpr std::array<std::string_view, severities> meanings{
        "in the data, hardly on the part", "shows on a polished or glossy surface", "shows on any finished surface",
        "too deep to polish out: rework or reject"};
    return meanings.at(static_cast<std::size_t>(severity - 1));
}

int severity_of(const SeverityEvidence& e, const SeverityRule& rule) {
    int severity = 1;
    for (std::size_t k = 0; k < rule.depth.size(); ++k)
        severity += e.depth >= rule.depth[k] && e.score >= rule.stands_out[k] ? 1 : 0;
    int by_motion = 1;
    for (const float score : rule.motion) by_motion += e.motion && e.score >= score ? 1 : 0;
    severity = std::max(severity, by_motion);
    return e.systematic ? std::min(severity, rule.most_systematic) : severity;
}

}  // namespace clsurf
