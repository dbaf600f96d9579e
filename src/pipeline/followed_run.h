#pragma once
// FollowedRun: the defects of a run that is still being recorded. The last passes of the log are judged again and again by the
// detector of complete logs (pipeline/judge.h), and each defect is reported once, when it is settled (settled_defect.h).
//
// Such findings are provisional: the thresholds of a window are those of its passes, not of the whole run, and later passes
// may lie beside what the window has lost. The verdict is that of the complete log; resolve() compares both.

#include <cstdint>
#include <optional>
#include <vector>

#include "pipeline/judge.h"
#include "pipeline/part.h"

namespace clsurf {

struct FollowRules {
    PartRules part;
    std::optional<Role> measured;  ///< positions that heights are measured from
    QualityRules quality;
    std::int64_t passes = 18;     ///< that are kept as neighbours of those to come …
    PointIndex points = 100'000;  ///< … but of long passes fewer, where these are more points
    std::int64_t least_passes = 10;
    PointIndex most_points = 400'000;  ///< that are kept at all
};

/// A defect that was found while the log was written. Its points and passes count from the beginning of the log.
struct ProvisionalDefect {
    std::int64_t number = 0;  ///< from 1
    Defect defect;
    PointIndex needed = 0;    ///< the last point that it is judged by
    PointIndex recorded = 0;  ///< records that there were when it was found
};

/// What the complete log says of the provisional findings.
struct ResolvedFindings {
    std::vector<std::vector<std::size_t>> defects;  ///< of each finding: indices of the report's defects that lie there
    std::vector<std::size_t> late;                  ///< indices of the report's defects that no finding had

    [[nodiscard]] std::size_t withdrawn() const;  ///< findings at whose places the complete log has no defect
};

class FollowedRun {
public:
    /// `program` as programmed, each motion in its own work system (assemble()); `first` decides how program and log lie to
    /// each other. Throws InputError: as assemble(); a log of another program is none here (foreign()).
    FollowedRun(Program program, Log first, FollowRules rules);

    /// Judges the records of the log from number `first` on, as many as `window` has, and returns the defects that are new.
    /// Throws InputError: the window lacks channels. O(points + motions), parallel.
    [[nodiscard]] std::vector<ProvisionalDefect> judge(Log window, PointIndex first);

    /// Records before that number are no neighbours of passes to come.
    [[nodiscard]] PointIndex kept_from() const { return kept_from_; }
    /// Why the last window does not belong to the program; empty: it does.
    [[nodiscard]] const std::string& foreign() const { return part_.lines->match().foreign; }
    [[nodiscard]] std::int64_t findings() const { return findings_; }

    [[nodiscard]] ResolvedFindings resolve(const QualityReport& complete) const;

private:
    struct Section {
        PointRange points;
        std::int64_t finding = 0;
        bool motion = false;  ///< of speeds and accelerations, not of heights
    };

    void leave_behind(const ClSurface& surface, PointIndex first);
    void choose_window(const ClSurface& surface, PointIndex first);
    [[nodiscard]] std::int64_t finding_of(const Defect& defect) const;
    [[nodiscard]] bool at_fault(PointIndex point) const;
    void remember(const Defect& defect, std::int64_t finding);

    FollowRules rules_;
    Part part_;
    std::vector<PointIndex> pass_ends_;  ///< last points of the cut passes of the last window, from the log's beginning
    std::int64_t passes_before_ = 0;     ///< cut passes before the window
    PointIndex kept_from_ = 0;
    std::int64_t findings_ = 0;
    std::int64_t systematic_ = 0;    ///< the finding that is a systematic lag; 0: none
    std::vector<Section> sections_;  ///< of findings, that the window still has …
    std::vector<Section> left_;      ///< … and that it has not
};

}  // namespace clsurf
