#pragma once
// Chords: for a point that moves along a run, the points a given way behind and ahead of it.
// Direction over a way, not over a number of samples, does not drown in noise where the tool is slow.

#include <cmath>

#include "core/point.h"
#include "path/positions.h"

namespace clsurf {

class Chords {
public:
    /// Stands at `point` of the run [first, last]; chords reach over `way` [mm] to each side, less at
    /// the run's ends. O(points in the window).
    Chords(const Positions& positions, PointRange run, PointIndex point, double way)
        : positions_(&positions), run_(run), way_(way), at_(point), behind_(point), ahead_(point) {
        while (behind_ > run_.first && way_behind_ < way_) way_behind_ += step(--behind_);
        extend();
    }

    /// Moves on by one point. Amortised O(1).
    void advance() {
        const double gone = step(at_);
        ++at_;
        way_behind_ += gone;
        way_ahead_ -= gone;
        while (behind_ < at_ && way_behind_ - step(behind_) >= way_) way_behind_ -= step(behind_++);
        extend();
    }

    [[nodiscard]] PointIndex point() const { return at_; }
    [[nodiscard]] PointIndex behind() const { return behind_; }
    [[nodiscard]] PointIndex ahead() const { return ahead_; }
    [[nodiscard]] double way_behind() const { return way_behind_; }  ///< [mm]
    [[nodiscard]] double way_ahead() const { return way_ahead_; }    ///< [mm]
    /// From the point behind to the point ahead; not normalised.
    [[nodiscard]] Eigen::Vector3f across() const {
        return (*positions_)[ahead_] - (*positions_)[behind_];
    }

private:
    [[nodiscard]] double step(PointIndex i) const {
        return static_cast<double>(((*positions_)[i + 1] - (*positions_)[i]).norm());
    }
    void extend() {
        if (ahead_ < at_) {
            ahead_ = at_;
            way_ahead_ = 0;
        }
        while (ahead_ < run_.last && way_ahead_ < way_) way_ahead_ += step(ahead_++);
    }

    const Positions* positions_;
    PointRange run_;
    double way_;
    PointIndex at_, behind_, ahead_;
    double way_behind_ = 0;
    double way_ahead_ = 0;
};

}  // namespace clsurf
