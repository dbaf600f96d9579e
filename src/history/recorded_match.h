#pragma once
// RecordedMatch: matches the defects of one run with the defects of another.
//
// Two runs never agree exactly: a defect moves by some points, and its score changes. Two defects are the
// same if they have the same cause and are within 5 mm of each other or on common lines. Each is matched once: if there
// are three defects instead of one, two of them are new.

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
    std::vector<std::size_t> gone;                  ///< known defects without a match

    /// Number of defects that are new or became worse.
    [[nodiscard]] std::size_t worsened() const;
};

/// Matches the nearest pairs first. O(defects · known).
[[nodiscard]] RecordedMatch match_recorded(std::span<const RecordedDefect> known,
                                           std::span<const RecordedDefect> defects);

}  // namespace clsurf
