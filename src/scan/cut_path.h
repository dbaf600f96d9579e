#pragma once
// CutPath: the tool path that produces the fitted profile, and the lines or spans of its program.
//
// A ball of radius r touches the fit if its centre is r along the normal above it. The programmed point is the lowest
// point of the ball, its tip. All places are (x, z) in mm.

#include <optional>
#include <span>
#include <vector>

#include "core/geometry.h"
#include "scan/windowed_fit.h"

namespace clsurf {

/// A place at which a ball cuts below the fit.
struct Gouge {
    double x = 0;             ///< [mm] of the contact
    double depth = 0;         ///< [mm] the deepest one
    double least_radius = 0;  ///< [mm] of concave curvature in the whole fit
};

/// A cubic between two places, by its derivatives at both ends; parameter t ∈ [0, 1].
struct CutSpan {
    Vec2 begin, end, begin_slope, end_slope;

    [[nodiscard]] Vec2 at(double t) const;
};

class CutPath {
public:
    /// Samples the path so densely that chords between samples are within a twentieth of `tolerance` [mm]. `radius`
    /// [mm]: 0: the tip follows the fit. O(points of the fit + samples).
    CutPath(WindowedFit fit, double radius, double tolerance);

    /// Samples of the path, in their order; x increases unless there is a gouge, and is constant at jumps of the fit.
    [[nodiscard]] std::span<const Vec2> samples() const { return samples_; }
    /// The contact of the ball and the fit at each sample: points of the fit, in ascending x.
    [[nodiscard]] std::span<const Vec2> contacts() const { return contacts_; }
    /// The deepest place at which the ball cuts more than the tolerance below the fit.
    [[nodiscard]] std::optional<Gouge> gouge() const;
    /// Ends of lines that stay within the tolerance of the path. They are samples, including the first and the last.
    [[nodiscard]] std::vector<Vec2> points() const;
    /// Cubics that stay within the tolerance of the path. At a jump of the fit the next one begins at another point.
    [[nodiscard]] std::vector<CutSpan> spans() const;

private:
    [[nodiscard]] Vec2 place(const FitPiece& piece, double x) const;
    [[nodiscard]] Vec2 derivative(const FitPiece& piece, double x) const;
    [[nodiscard]] CutSpan span_of(const FitPiece& piece, double from, double to) const;

    WindowedFit fit_;
    double radius_, tolerance_;
    std::vector<Vec2> samples_, contacts_;
};

}  // namespace clsurf
