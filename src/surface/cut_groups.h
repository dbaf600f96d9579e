#pragma once
// Passes that cannot be adjacent, however near they are: passes of two tools (the finishing passes run over the surface of
// another tool), and passes of two runs of a program in one log (of two parts, or of one part that was cut twice).

#include <cstdint>
#include <span>
#include <vector>

#include "mapping/program_runs.h"
#include "surface/passes.h"

namespace clsurf {

/// The order of cutting in a log: its runs of the program, and whether several tools cut.
struct CutOrder {
    const LineMap* lines = nullptr;  ///< nullptr: unknown
    std::vector<ProgramRun> runs;

    CutOrder() = default;
    /// `lines` must outlive it. O(points).
    explicit CutOrder(const LineMap& of_points) : lines(&of_points), runs(find_program_runs(of_points)) {}
};

/// The pieces, with a link at the begin of a run inside a cut: there may be no rapid between two runs.
[[nodiscard]] Passes cut_at_runs(const Passes& pieces, std::span<const ProgramRun> runs);

class CutGroups {
public:
    /// All passes may be adjacent.
    CutGroups() = default;
    /// O(passes).
    CutGroups(const CutOrder& order, const Passes& passes);

    /// Whether passes a and b, by number, cannot be neighbours. A program may be stopped and restarted from an earlier line.
    /// Then the passes of the two runs are apart where both runs cut. Where only one of them cut, its passes are neighbours
    /// of the other's.
    [[nodiscard]] bool apart(std::size_t a, std::size_t b) const {
        if (of_pass_.empty()) return false;
        const OfPass& mine = of_pass_[a];
        const OfPass& other = of_pass_[b];
        if (mine.tool != other.tool) return true;
        return mine.run != other.run && other.last >= runs_[mine.run].first_motion &&
               other.first <= runs_[mine.run].last_motion;
    }

private:
    struct OfPass {
        std::uint32_t tool = 0;
        std::uint32_t run = 0;
        std::int64_t first = -1, last = -1;  ///< motions; −1: unknown
    };

    std::vector<ProgramRun> runs_;
    std::vector<OfPass> of_pass_;  ///< empty: one tool and one run
};

}  // namespace clsurf
