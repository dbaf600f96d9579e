#pragma once
// SamplesInWork: the samples of a log during their derivation. They are derived step by step for the whole log, or block by
// block when a block is first read (Signals::motion, zones, heights).

#include "core/block_fill.h"
#include "predictor/sample.h"

namespace clsurf {

/// Access to samples during their derivation: derives a value before it is read. It does not own the samples.
class SamplesInWork {
public:
    explicit SamplesInWork(Sample* samples) : samples_(samples) {}
    SamplesInWork(Sample* samples, BlockFill* motion, BlockFill* zones)
        : samples_(samples), motion_(motion), zones_(zones) {}

    /// For writing.
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
    BlockFill* motion_ = nullptr;  ///< nullptr: all samples are derived before they are read
    BlockFill* zones_ = nullptr;
};

}  // namespace clsurf
