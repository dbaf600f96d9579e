#pragma once
// Scallop height of ball-end passes in closed form, for exact circles (no parabolic approximation).

namespace clsurf {

/// Height of the cusp [mm] between two passes of a ball of radius `ball` [mm] whose contact points are `step_over` [mm] apart
/// (a chord), on a surface of normal radius `rho` [mm] across the feed: > 0 convex, < 0 concave, infinite: flat. Throws
/// std::domain_error if passes do not meet (step_over ≥ 2 ball) or the ball gouges (concave, ball ≥ |rho|).
[[nodiscard]] double scallop_height(double ball, double step_over, double rho);

/// The same between two contact points, `chord` [mm] apart across the feed. `turn` [mm]: dot product of the difference of their
/// normals and the chord, which gives the curvature; > 0: convex. NaN: passes do not meet, the ball gouges, or the input is not
/// known.
[[nodiscard]] double cusp_height(double ball, double chord, double turn);

}  // namespace clsurf
