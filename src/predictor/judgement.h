#pragma once
// Judgement: whether the data of a report allow a verdict. A report without defects means nothing if nothing could be compared.
// Such a report is "not judged": it meets no budget, and `check` has a separate exit code for it.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace clsurf {

/// Share of the cutting points that must be compared with the passes on both sides, 0 … 1
/// (docs/design/predictor.md#6-decide-whether-the-data-allow-a-verdict).
inline constexpr double least_coverage = 0.5;

struct Judgement {
    /// Why the report is not judged: full sentences for users. Empty: it is judged.
    std::vector<std::string> reasons;

    [[nodiscard]] bool judged() const { return reasons.empty(); }
    /// Adds a reason. A sentence that is already in the list is not repeated.
    void refuse(std::string reason) {
        if (std::find(reasons.begin(), reasons.end(), reason) == reasons.end()) reasons.push_back(std::move(reason));
    }
};

}  // namespace clsurf
