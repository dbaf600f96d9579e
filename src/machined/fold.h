#pragma once
// Fold: two smooth sheets that meet at a crease. The form of a part whose programmed surface has edges is the lower
// sheet at a ridge and the higher one in a valley, so that an edge is no roughness.

#include <cmath>
#include <optional>
#include <span>

#include "machined/local_quadratic.h"

namespace clsurf {

/// A place of the programmed surface about a knot. Lengths in any one unit, weight ≥ 0.
struct WeighedPlace {
    double x = 0, y = 0, z = 0, weight = 0;
};

struct Fold {
    LocalQuadratic::Terms one = LocalQuadratic::Terms::Zero(), two = LocalQuadratic::Terms::Zero();
    bool ridge = true;  ///< the lower sheet is the part's; false: a valley, the higher one is

    [[nodiscard]] bool is_on_one(double x, double y) const;
    /// The form.
    [[nodiscard]] double at(double x, double y) const;
};

/// z of a quadratic: a0 + a1 x + a2 y + a3 x² + a4 xy + a5 y².
[[nodiscard]] double value_of(const LocalQuadratic::Terms& a, double x, double y);

/// What share of the places' weight lies farther than `most` from f(x, y).
template <typename Surface>
[[nodiscard]] double share_off(std::span<const WeighedPlace> places, double most, Surface&& f) {
    double off = 0;
    double all = 0;
    for (const WeighedPlace& p : places) {
        all += p.weight;
        if (!(std::abs(p.z - f(p.x, p.y)) <= most)) off += p.weight;
    }
    return all > 0 ? off / all : 1;
}

/// The two sheets through the places. `smooth`, one quadratic through all of them, tells across which direction
/// the crease lies: where it bends most. Splits by parallel lines are tried, and from the best one the
/// places go to the sheet that is the form's at their place until they stay there (Lloyd's iteration). `most`: a distance
/// that no place of a sheet should exceed; `least_spread` as of LocalQuadratic::fit(). nullopt: a sheet has too few places.
/// O(places).
[[nodiscard]] std::optional<Fold> fit_fold(std::span<const WeighedPlace> places, const LocalQuadratic::Terms& smooth,
                                           double most, double least_spread, LocalQuadratic& quadratic);

}  // namespace clsurf
