#pragma once
// CubicSpan: one cubic of a curve in space, r(u) = A + B u + C u² + D u³.

#include <array>

#include "core/geometry.h"

namespace clsurf {

struct CubicSpan {
    std::array<Vec3, 4> coefficients;  ///< A, B, C, D
    double chord = 0;                  ///< end of the range of u [mm]
    int pieces = 1;                    ///< number of pieces into which arc_length_to() divides its interval

    [[nodiscard]] Vec3 at(double u) const;          ///< [mm], u ∈ [0, chord]
    [[nodiscard]] Vec3 derivative(double u) const;  ///< dr/du
    [[nodiscard]] Vec3 second_derivative(double u) const;
    /// Arc length from u = 0 to `u` [mm], by Gauss's rule with 5 points in each piece.
    [[nodiscard]] double arc_length_to(double u) const;
    /// Chooses the number of pieces that makes arc_length_to() exact. One is enough for a gentle bend. In a sharp one the
    /// speed |dr/du| varies so much that a single rule is wrong by 10⁻⁴, which jumps from curve to curve.
    void choose_pieces();
    /// The u at which the arc length from u = 0 is `arc_length` [mm], clipped to [0, chord]; `length`: arc_length_to(chord).
    /// Newton's method, kept in a bracket.
    [[nodiscard]] double at_arc_length(double arc_length, double length) const;
    [[nodiscard]] double at_arc_length(double arc_length) const {
        return at_arc_length(arc_length, arc_length_to(chord));
    }
};

/// The cubic from `begin` to `end` with these derivatives there, over u ∈ [0, chord].
[[nodiscard]] CubicSpan hermite(const Vec3& begin, const Vec3& end, const Vec3& derivative_at_begin,
                                const Vec3& derivative_at_end, double chord);

}  // namespace clsurf
