#pragma once
// Suspects: the sites of a surface that differ from their neighbour passes, and how they belong
// together.

#include <array>
#include <vector>

#include "predictor/mismatch.h"
#include "toolpath/arc_length.h"

namespace clsurf {

struct Suspect {
    PointIndex point = 0;
    std::size_t pass = 0;  ///< index into surface.passes
    bool border = false;   ///< no pass on one side, or one begins or ends there: the difference is expected
    bool turns = false;    ///< at a border: the path turns there
    bool bend = false;     ///< a bend explains its motion (bend.h): that difference is expected
    std::array<float, quantities> share{};  ///< |residual| over threshold
    std::array<float, quantities> score{};  ///< the same, where the step passes it too; from 1 on a defect starts
    Comparison comparison;

    [[nodiscard]] bool bends(Quantity q) const { return bend && (q == Quantity::speed || q == Quantity::acceleration); }
    /// What it shows of a quantity is expected there.
    [[nodiscard]] bool expected(Quantity q) const { return border || bends(q); }
};

/// The pass that holds a point. O(log passes).
[[nodiscard]] std::size_t pass_of(const Passes& passes, PointIndex point);

/// Points of cut passes that have a neighbour on both sides and lie away from the ends. O(points).
[[nodiscard]] PointIndex count_compared(const ClSurface& surface, const Signals& signals);

/// Some suspects, in the order of their points. They stay where they were found: each is 150 bytes, and
/// a bad part has a million.
using Suspects = std::vector<const Suspect*>;

/// All suspects of a part, and where they are kept.
struct FoundSuspects {
    std::vector<std::vector<Suspect>> kept;
    Suspects suspects;
};

/// Sites (sites.h) whose residual passes half a threshold, in the order of their points. Only sites with a step are
/// looked at with all passes around, and then what lies beside a suspect: the inner passes of a band
/// have no step of their own. O(points), parallel; the same for any number of threads.
[[nodiscard]] FoundSuspects find_suspects(const ClSurface& surface, const Signals& signals, const Way& way,
                                          const Thresholds& thresholds);

/// How much way [mm] may lie between suspects of one pass that belong together: a millimetre, two step-overs or two records, with room.
/// `record`: the way of one at the usual speed.
[[nodiscard]] double joined_along(const ClSurface& surface, double record);

/// Suspects that hang together along a pass (`along`: joined_along()), across to the next one or over one clean pass; each group
/// in the order of its points, and groups in the order of their first ones. O(suspects log suspects), parallel.
[[nodiscard]] std::vector<Suspects> group_suspects(const Suspects& suspects, const ClSurface& surface, const Way& way,
                                                   double along);

}  // namespace clsurf
