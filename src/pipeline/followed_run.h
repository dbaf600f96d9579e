#pragma once
// FollowedRun: the defects of a run that is still being recorded. The last passes of the log are judged repeatedly by the
// detector for complete logs (pipeline/judge.h). Each defect is reported once, when it is settled (settled_defect.h).
//
// These findings are provisional: the thresholds of a window are those of its passes, not of the whole run, and later
// passes may be adjacent to passes that have left the window. The complete log gives the verdict; resolve() compares
// both.

#include <cstdint>
#include <optional>
#include <vector>

#include "pipeline/judge.h"
#include "pipeline/part.h"

namespace clsurf {

struct FollowRules {
    PartRules part;
    std::optional<Role> measured;  ///< positions from which heights are measured
    QualityRules quality;
    std::int64_t passes = 18;     ///< number of passes kept as neighbours of later passes …
    PointIndex points = 100'000;  ///< … or fewer if these have more points than this
    std::int64_t least_passes = 10;
    PointIndex most_points = 400'000;  ///< largest number of points kept in any case
};

/// A defect that was found while the log was being written. Points and passes are counted from the start of the log.
struct ProvisionalDefect {
    std::int64_t number = 0;  ///< from 1
    Defect defect;
    PointIndex needed = 0;    ///< the last point that is needed to judge it
    PointIndex recorded = 0;  ///< number of records at the time it was found
};

/// The result of the complete log for the provisional findings.
struct ResolvedFindings {
    std::vector<std::vector<std::size_t>> defects;  ///< for each finding: indices of the report's defects at its place
    std::vector<std::size_t> late;                  ///< indices of the report's defects without a finding

    [[nodiscard]] std::size_t withdrawn() const;  ///< number of findings without a defect in the complete log
};

class FollowedRun {
public:
    /// `program` as programmed, each motion in its own work system (assemble()); `first` determines the pose of program and
    /// log. Throws InputError: as assemble(), but not for a log of another program (foreign()).
    FollowedRun(Program program, Log first, FollowRules rules);

    /// Judges the records of the log in `window`, which begins at number `first`, and returns the new defects. Throws
    /// InputError: the window lacks channels. O(points + motions), parallel.
    [[nodiscard]] std::vector<ProvisionalDefect> judge(Log window, PointIndex first);

    /// Records before that number are not needed as neighbours of later passes.
    [[nodiscard]] PointIndex kept_from() const { return kept_from_; }
    /// The reason why the last window does not belong to the program; empty: it does.
    [[nodiscard]] const std::string& foreign() const { return part_.lines->match().foreign; }
    [[nodiscard]] std::int64_t findings() const { return findings_; }

    [[nodiscard]] ResolvedFindings resolve(const QualityReport& complete) const;

private:
    struct Section {
        PointRange points;
        std::int64_t finding = 0;
        bool motion = false;  ///< a defect of speeds and accelerations, not of heights
    };

    void count_passes_left(const ClSurface& surface, PointIndex first);
    void choose_window(const ClSurface& surface, PointIndex first);
    [[nodiscard]] std::int64_t finding_of(const Defect& defect) const;
    [[nodiscard]] bool has_defect(PointIndex point) const;
    void remember(const Defect& defect, std::int64_t finding);

    FollowRules rules_;
    Part part_;
    std::vector<PointIndex> pass_ends_;  ///< last points of the cut passes of the last window, as points of the log
    std::int64_t passes_before_ = 0;     ///< cut passes before the window
    PointIndex kept_from_ = 0;
    std::int64_t findings_ = 0;
    std::int64_t systematic_ = 0;    ///< number of the finding that is a systematic lag; 0: none
    std::vector<Section> sections_;  ///< sections of findings within the window …
    std::vector<Section> left_;      ///< … and before it
};

}  // namespace clsurf
