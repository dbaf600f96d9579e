#pragma once
// SamplesInWork: the samples of a log while they are derived, all of them one step after the other, or a block when it
// is first read (Signals::motion, zones, heights).

#include "core/block_fill.h"
#include "predictor/sample.h"

namespace clsurf {

/// The samples of a log while they are derived. What is read of them is derived before. A value: it does not own them.
class SamplesInWork {
public:
    explicit SamplesInWork(Sample* samples) : samples_(samples) {}
    SamplesInWork(Sample* samples, BlockFill* motion, BlockFill* zones)
        : samples_(samples), motion_(motion), zones_(zones) {}

    /// To be written.
    [[nodiscard]] Sample& operator[](PointIndex i) const { return samples_[i]; }
    [[nodiscard]] float speed(PointIndex i) const { return with(motion_, i).speed; }
    [[nodiscard]] Eigen::Map<const Eigen::Vector3f> feed(PointIndex i) const {
        return vector_of(with(motion_, i).feed);
    }
    [[nodiscard]] Zone zone(PointIndex i) const { return with(zones_, i).zone; }

private:
    [[nodiscard]] const Sample& with(BlockFill* fill, PointIndex i) const {
        if (fill != nullptr) fill->need(i);
        return samples_[i];
    }

    Sample* samples_;
    BlockFill* motion_ = nullptr;  ///< nullptr: all of it is derived before it is read
    BlockFill* zones_ = nullptr;
};

}  // namespace clsurf
