#pragma once
// Which passes cannot lie beside each other, however near they are: those of two tools (the finishing passes run over
// what another tool has left), and those of two runs of a program in one log (of two parts, or of one that was cut twice).

#include <cstdint>
#include <span>
#include <vector>

#include "mapping/program_runs.h"
#include "surface/passes.h"

namespace clsurf {

/// What a log has: its runs of the program, and whether several tools cut.
struct CutOrder {
    const LineMap* lines = nullptr;  ///< nullptr: nothing is known
    std::vector<ProgramRun> runs;

    CutOrder() = default;
    /// `lines` must outlive it. O(points).
    explicit CutOrder(const LineMap& of_points) : lines(&of_points), runs(find_program_runs(of_points)) {}
};

/// The pieces, with a link where a run of the program begins inside a cut: no rapid may lie between two runs.
[[nodiscard]] Passes cut_at_runs(const Passes& pieces, std::span<const ProgramRun> runs);

class CutGroups {
public:
    /// All passes may lie beside each other.
    CutGroups() = default;
    /// O(passes).
    CutGroups(const CutOrder& order, const Passes& passes);

    /// Whether passes a and b, by number, cannot be neighbours. A program may be stopped and begun again from an earlier line.
    /// The passes of the two runs are then apart where both runs cut. Where only one of them cut, its passes are neighbours of
    /// the other's.
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
        std::int64_t first = -1, last = -1;  ///< motions; −1: not known
    };

    std::vector<ProgramRun> runs_;
    std::vector<OfPass> of_pass_;  ///< empty: one tool and one run
};

}  // namespace clsurf
