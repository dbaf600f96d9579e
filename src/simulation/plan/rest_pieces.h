#pragma once
// RestPieces: the sections next to a rest, where v² is not a quadratic of u and the jerk is constant. Their length is
// limited: after a section, the acceleration has to return to zero and the speed has to fall before the next bends.

#include <span>

#include "simulation/plan/five_axis_limits.h"

namespace clsurf {

/// Motion from or to a rest at constant jerk.
struct RestPiece {
    double jerk = 0, time = 0;  ///< jerk of u, and duration
    [[nodiscard]] double length() const { return jerk * time * time * time / 6; }
};

class RestPieces {
public:
    /// Both references must outlive the object.
    RestPieces(const FiveAxisLimits& limits, std::span<const LimitPlace> places) : limits_(&limits), places_(places) {}

    /// `side`: 1 for the section after a rest, −1 for the section before it; `length`: to the next rest. If joints near the
    /// rest permit less jerk, the section ends before them.
    [[nodiscard]] RestPiece at(double rest, int side, double length) const;

private:
    [[nodiscard]] bool settles(double rest, int side, const RestPiece& piece, double share) const;
    [[nodiscard]] bool slows_for_bends(double rest, int side, double from, double speed, double jerk) const;
    [[nodiscard]] double jerk_along(double rest, int side, double length) const;
    [[nodiscard]] double jerk_at(double at, double rest, int side) const;
    [[nodiscard]] std::span<const LimitPlace> between(double a, double b) const;

    const FiveAxisLimits* limits_;
    std::span<const LimitPlace> places_;
};

}  // namespace clsurf
