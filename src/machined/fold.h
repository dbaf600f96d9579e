#pragma once
// Fold: two smooth sheets that meet at a crease. If the programmed surface has edges, the form is the lower sheet at a ridge
// and the higher one in a valley, so that an edge does not count as roughness.

#include <cmath>
#include <optional>
#include <span>

#include "machined/local_quadratic.h"

namespace clsurf {

/// A weighted place of the programmed surface near a knot. Lengths in any one unit, weight ≥ 0.
struct WeighedPlace {
    double x = 0, y = 0, z = 0, weight = 0;
};

struct Fold {
    LocalQuadratic::Terms one = LocalQuadratic::Terms::Zero(), two = LocalQuadratic::Terms::Zero();
    bool ridge = true;  ///< the form is the lower sheet; false: it is the higher one, in a valley

    [[nodiscard]] bool is_on_one(double x, double y) const;
    /// Height of the form.
    [[nodiscard]] double at(double x, double y) const;
};

/// z of a quadratic: a0 + a1 x + a2 y + a3 x² + a4 xy + a5 y².
[[nodiscard]] double value_of(const LocalQuadratic::Terms& a, double x, double y);

/// The share of the places' weight that is farther than `most` from f(x, y).
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

/// Fits two sheets to the places. `smooth`, one quadratic through all of them, gives the direction across the crease: the
/// direction in which it bends most. The places are split by several parallel lines. From the best split on, places are
/// assigned to the sheet that is the form at their position, until the assignment is stable (Lloyd's iteration). `most`: a
/// distance that no place of a sheet should exceed; `least_spread` as for LocalQuadratic::fit(). nullopt: a sheet has too few
/// places. O(places).
[[nodiscard]] std::optional<Fold> fit_fold(std::span<const WeighedPlace> places, const LocalQuadratic::Terms& smooth,
                                           double most, double least_spread, LocalQuadratic& quadratic);

}  // namespace clsurf
