#pragma once
// FiveAxisPath: the path of the tip and of both angles between two rests, as one curve with a continuous third derivative.
//
// Blocks become chords of (tip, angles) over one parameter u. At each joint of two chords the slope jumps by Δ. Smoothing
// with the kernel K(d) = 15/(16 w) (1 − (d/w)²)², |d| < w, removes the jump by adding
//
//     Δ w G(|d|/w),     G(x) = 15/16 (1/6 − 8x/15 + x²/2 − x⁴/6 + x⁶/30).
//
// The tip and the angles have separate widths, from their separate tolerances. If roundings overlap, their sum at any
// place stays within the tolerance. The linear axes follow from both by the kinematics, with their derivatives.

#include <cstdint>
#include <vector>

#include "machine/kinematics.h"
#include "simulation/path/axis_sample.h"

namespace clsurf {

using FiveAxes = AxisVector<5>;

/// A chord of the path.
struct FiveAxisChord {
    FiveAxes end = FiveAxes::Zero();  ///< tip [mm], tilt, rotation [rad]
    double feed = 0;                  ///< of the tip, with the override [mm/s]; infinite for a rapid
    /// Speed of both angles together if only they move [rad/s]; infinite if the feed is that of the tip.
    double turn_speed = infinite_speed;
    double tolerance = 0;  ///< tolerance of the tip at the start of the chord [mm]
    bool inside = false;   ///< the chord begins within a curved block
    std::uint32_t block = 0;
    double part_from = 0, part_to = 1;  ///< of the block
};

/// A place on the path.
struct FiveAxisPlace {
    Vec3 tip = Vec3::Zero();
    RotaryAngles angles;
    double deviation = 0;  ///< of the tip from its chord [mm]
    double pace = 0;       ///< derivative of the tip's arc length by u
};

class FiveAxisPath {
public:
    /// `zero`: the machine position of the program's zero [mm]. O(chords).
    FiveAxisPath(const Kinematics& kinematics, const Vec3& zero, const FiveAxes& begin,
                 const std::vector<FiveAxisChord>& chords);

    [[nodiscard]] double length() const { return ends_.empty() ? 0 : ends_.back(); }
    [[nodiscard]] std::size_t chord_at(double u) const;
    [[nodiscard]] const FiveAxisChord& chord(std::size_t i) const { return chords_[i]; }
    /// The share of the chord's block before u.
    [[nodiscard]] double part_at(std::size_t chord, double u) const;
    [[nodiscard]] FiveAxisPlace at(double u) const;
    /// Distance of u from the nearest rounding, or from a joint without rounding; 0 within a rounding.
    [[nodiscard]] double clearance(double u) const;
    /// Turn of the angles per u there, without roundings [rad].
    [[nodiscard]] double turning(double u) const { return slopes_[chord_at(u)].tail<2>().norm(); }
    /// Derivatives of x, y, z, tilt and rotation by u; `tip`: output, those of the tip.
    [[nodiscard]] AxisSample<5> derivatives(double u, PathDerivatives& tip) const;
    /// Places where derivatives change fast, in order. A polyline through them follows every corner.
    [[nodiscard]] std::vector<double> places() const;

private:
    struct Joint {
        FiveAxes turn = FiveAxes::Zero();
        double tip_width = 0, angle_width = 0;
    };
    /// Value and first to third derivative.
    using Jet = std::array<FiveAxes, 4>;
    void set_widths();
    void fit(double Joint::*width, int first, int count, const std::vector<double>& tolerances);
    [[nodiscard]] double begin_of(std::size_t chord) const { return chord == 0 ? 0 : ends_[chord - 1]; }
    [[nodiscard]] Jet jet(double u, std::size_t chord) const;

    const Kinematics* kinematics_;
    Vec3 zero_;
    std::vector<FiveAxisChord> chords_;
    std::vector<FiveAxes> begins_, slopes_;
    std::vector<double> ends_;
    std::vector<Joint> joints_;  ///< joint j: between chords j and j + 1
};

}  // namespace clsurf
