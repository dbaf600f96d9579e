#pragma once
// CutPath: where the tool goes so that it leaves the fitted profile, and the lines or spans that it is written as.
//
// A ball of radius r touches the fit where its centre is r along the normal above it. What is programmed is the lowest
// point of the ball, its tip. All places are (x, z) in mm.

#include <optional>
#include <span>
#include <vector>

#include "core/geometry.h"
#include "scan/windowed_fit.h"

namespace clsurf {

/// Where a ball cuts below the fit.
struct Gouge {
    double x = 0;             ///< [mm] of the contact
    double depth = 0;         ///< [mm] the deepest one
    double least_radius = 0;  ///< [mm] of concave curvature in the whole fit
};

/// A cubic from one place to another, by the tangents at its ends: derivatives by t ∈ [0, 1].
struct CutSpan {
    Vec2 begin, end, begin_slope, end_slope;

    [[nodiscard]] Vec2 at(double t) const;
};

class CutPath {
public:
    /// Samples the path so closely that chords between samples are within a twentieth of `tolerance` [mm].
    /// `radius` [mm]: 0: the tip follows the fit. O(points of the fit + samples).
    CutPath(WindowedFit fit, double radius, double tolerance);

    /// Samples of the path, in their order; x rises where nothing is gouged, and stays where the fit jumps.
    [[nodiscard]] std::span<const Vec2> samples() const { return samples_; }
    /// Where the ball touches the fit at each sample: places of the fit, in rising x.
    [[nodiscard]] std::span<const Vec2> contacts() const { return contacts_; }
    /// The deepest place where the ball cuts more than the tolerance below the fit.
    [[nodiscard]] std::optional<Gouge> gouge() const;
    /// Ends of lines that stay within the tolerance of the path. They are samples, the first and the last among them.
    [[nodiscard]] std::vector<Vec2> points() const;
    /// Cubics that stay within the tolerance of the path. Where the fit jumps, one ends beside the begin of the next.
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
