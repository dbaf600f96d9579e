#pragma once
// RecordedMatch: the defects of one run found again among those of another.
//
// A run is never exactly like the one before it: a defect moves by some points, and its score changes. Two defects are the
// same one where they have one cause and lie within 5 mm of each other or on common lines. Each is found again once: three
// defects where there was one are two new ones.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "history/run_record.h"

namespace clsurf {

enum class DefectState : std::uint8_t { unchanged, worse, fresh };
[[nodiscard]] std::string_view name_of(DefectState state);  ///< "unchanged", "worse", "new"

struct RecordedMatch {
    std::vector<std::optional<std::size_t>> known;  ///< per defect of the run: its index among the known ones
    std::vector<DefectState> states;                ///< per defect of the run; worse: of a higher severity
    std::vector<std::size_t> gone;                  ///< known ones that were not found again

    /// New ones and those that became worse.
    [[nodiscard]] std::size_t worsened() const;
};

/// The nearest pairs first. O(defects · known).
[[nodiscard]] RecordedMatch match_recorded(std::span<const RecordedDefect> known,
                                           std::span<const RecordedDefect> defects);

}  // namespace clsurf
