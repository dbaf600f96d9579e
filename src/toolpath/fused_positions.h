#pragma once
// FusedPositions: actual positions of all axes, each from its scale and its motor's encoder (fused_axis.h).

#include <array>
#include <string>
#include <vector>

#include "log/log.h"
#include "toolpath/fused_axis.h"
#include "toolpath/trajectory.h"

namespace clsurf {

class FusedPositions {
public:
    /// Whether `path` has actual positions, the log has feedback positions too, and no rotary axis is between them.
    [[nodiscard]] static bool applies(const Log& log, const Trajectory& path);

    /// Noise and delay are measured in `pieces`. O(points).
    FusedPositions(const Log& log, const Trajectory& path, const std::vector<PointRange>& pieces, NoiseFitter& fitter);

    /// The actual positions, fused. Owns its columns.
    [[nodiscard]] const Trajectory& path() const { return path_; }
    [[nodiscard]] const std::array<FusedAxis, 3>& axes() const { return axes_; }
    /// Lower bound of the uncertainty of fused positions [mm], and of positions of the scales.
    [[nodiscard]] double floor() const { return floor_; }
    [[nodiscard]] double scale_floor() const { return scale_floor_; }
    /// Ratio of the uncertainties of a position by the scale alone and by both: σ_s / σ, of the worst axis.
    [[nodiscard]] double alone() const;

    /// Standard deviation of the remaining difference of the encoder, in a derivative of an axis' position [mm/s^d]; infinite
    /// if its scale is used alone.
    void sigmas(std::size_t axis, int derivative, PointIndex first, std::span<double> out) const;
    /// Parts of a range in which every moving axis also uses its encoder.
    [[nodiscard]] std::vector<PointRange> fused_ranges(PointRange range) const;
    /// The same for the worst axis, far from reversals.
    [[nodiscard]] double remaining(int derivative) const;

    /// "scale ±0.29 µm and encoder ±0.029 µm, 2.4 records ahead, backlash 10/8/0 µm".
    [[nodiscard]] std::string note() const;

private:
    Trajectory path_;
    std::array<FusedAxis, 3> axes_;
    double floor_ = finest_position, scale_floor_ = finest_position;
};

}  // namespace clsurf
