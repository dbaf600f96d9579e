#pragma once
// AlignedHeights: a measurement as heights over places on the part.

#include <vector>

#include "machined/across_feed.h"
#include "measured/measured_data.h"
#include "measured/pose.h"

namespace clsurf {

class AlignedHeights {
public:
    /// `measured` must outlive it.
    AlignedHeights(const MeasuredData& measured, const Pose& pose);

    /// The row along the profile from end to end, with the measured spacing but at least `least_step` [mm]; for a profile only.
    [[nodiscard]] ProfileRow own_row(double least_step) const;
    /// Height [mm] over a place, interpolated linearly. For a profile, only places on own_row() are valid. NaN: nothing was
    /// measured there.
    [[nodiscard]] double at(const Vec2& place) const;
    /// The middle of the measured region [mm], seen from above.
    [[nodiscard]] const Vec2& middle() const { return middle_; }
    /// [mm] between neighbouring places.
    [[nodiscard]] double spacing() const { return spacing_; }

private:
    [[nodiscard]] double along_profile(const Vec2& place) const;
    [[nodiscard]] double over_map(const Vec2& place) const;
    [[nodiscard]] double map_height(double column, double row) const;

    const MeasuredData& measured_;
    Pose pose_;
    Vec2 middle_ = Vec2::Zero();
    double spacing_ = 0;
    Vec2 from_ = Vec2::Zero(), along_ = Vec2::UnitX();  ///< of a profile
    std::vector<double> distance_, height_;             ///< of the profile's points; distances increase
};

}  // namespace clsurf
