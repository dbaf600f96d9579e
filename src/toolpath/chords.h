#pragma once
// Chords: for a point that moves along a run, the points at a given arc length before and after it. A direction over
// an arc length, instead of a number of samples, is not lost in noise if the tool is slow.

#include "core/point.h"
#include "toolpath/arc_length.h"

namespace clsurf {

class Chords {
public:
    /// Starts at `point` of the run [first, last]; chords extend over `arc_length` [mm] to each side, less at the
    /// run's ends. O(points in the window).
    Chords(const ArcLength& lengths, PointRange run, PointIndex point, float arc_length)
        : lengths_(&lengths), run_(run), arc_length_(arc_length), at_(point), behind_(point), ahead_(point) {
        while (behind_ > run_.first && arc_length_behind_ < arc_length_) arc_length_behind_ += step(--behind_);
        extend();
    }

    /// Advances by one point. Amortised O(1).
    void advance() {
        const float gone = step(at_);
        ++at_;
        arc_length_behind_ += gone;
        arc_length_ahead_ -= gone;
        while (behind_ < at_ && arc_length_behind_ - step(behind_) >= arc_length_)
            arc_length_behind_ -= step(behind_++);
        extend();
    }

    [[nodiscard]] PointIndex point() const { return at_; }
    [[nodiscard]] PointIndex behind() const { return behind_; }
    [[nodiscard]] PointIndex ahead() const { return ahead_; }
    [[nodiscard]] float arc_length_behind() const { return arc_length_behind_; }  ///< [mm]
    [[nodiscard]] float arc_length_ahead() const { return arc_length_ahead_; }    ///< [mm]

private:
    [[nodiscard]] float step(PointIndex i) const { return lengths_->step(i); }
    void extend() {
        if (ahead_ < at_) {
            ahead_ = at_;
            arc_length_ahead_ = 0;
        }
        while (ahead_ < run_.last && arc_length_ahead_ < arc_length_) arc_length_ahead_ += step(ahead_++);
    }

    const ArcLength* lengths_;
    PointRange run_;
    float arc_length_;
    PointIndex at_, behind_, ahead_;
    float arc_length_behind_ = 0;
    float arc_length_ahead_ = 0;
};

}  // namespace clsurf
