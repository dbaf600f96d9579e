#pragma once
// Chords: for a point that moves along a run, the points a given arc length before and after it. A direction
// over an arc length, not over a number of samples, is not lost in noise where the tool is slow.

#include "core/point.h"
#include "toolpath/arc_length.h"

namespace clsurf {

class Chords {
public:
    /// Stands at `point` of the run [first, last]; chords reach over `way` [mm] to each side, less at
    /// the run's ends. O(points in the window).
    Chords(const Way& lengths, PointRange run, PointIndex point, float way)
        : lengths_(&lengths), run_(run), way_(way), at_(point), behind_(point), ahead_(point) {
        while (behind_ > run_.first && way_behind_ < way_) way_behind_ += step(--behind_);
        extend();
    }

    /// Moves on by one point. Amortised O(1).
    void advance() {
        const float gone = step(at_);
        ++at_;
        way_behind_ += gone;
        way_ahead_ -= gone;
        while (behind_ < at_ && way_behind_ - step(behind_) >= way_) way_behind_ -= step(behind_++);
        extend();
    }

    [[nodiscard]] PointIndex point() const { return at_; }
    [[nodiscard]] PointIndex behind() const { return behind_; }
    [[nodiscard]] PointIndex ahead() const { return ahead_; }
    [[nodiscard]] float way_behind() const { return way_behind_; }  ///< [mm]
    [[nodiscard]] float way_ahead() const { return way_ahead_; }    ///< [mm]

private:
    [[nodiscard]] float step(PointIndex i) const { return lengths_->step(i); }
    void extend() {
        if (ahead_ < at_) {
            ahead_ = at_;
            way_ahead_ = 0;
        }
        while (ahead_ < run_.last && way_ahead_ < way_) way_ahead_ += step(ahead_++);
    }

    const Way* lengths_;
    PointRange run_;
    float way_;
    PointIndex at_, behind_, ahead_;
    float way_behind_ = 0;
    float way_ahead_ = 0;
};

}  // namespace clsurf
