#pragma once
// RestPieces: next to a rest, where v² is no quadratic of u, the jerk is constant. How long such a piece may be: its
// acceleration has to vanish again, and its speed to fall, before the bends behind it.

#include <span>

#include "simulation/plan/five_axis_limits.h"

namespace clsurf {

/// From or to a rest at constant jerk.
struct RestPiece {
    double jerk = 0, time = 0;  ///< of u
    [[nodiscard]] double length() const { return jerk * time * time * time / 6; }
};

class RestPieces {
public:
    /// Both must outlive it.
    RestPieces(const FiveAxisLimits& limits, std::span<const LimitPlace> places) : limits_(&limits), places_(places) {}

    /// `side`: 1 for the piece behind a rest, -1 for that before one; `length`: to the next rest. Where joints
    /// near the rest want less jerk, the piece ends before them.
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
