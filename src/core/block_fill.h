#pragma once
// BlockFill: columns whose blocks are filled when they are first read. Of a log that is too large for memory, only
// what is looked at is computed: the points of a shard, and those beside it that it is compared with.
//
// Any number of threads may read. What fills a block must not read a block of its own columns, but it may read columns
// that are filled by another BlockFill, and so on: a block waits for other columns only, and never in a circle. It must
// not work in parallel (a thread that waits for its helpers would take up other work, which may wait for this block).

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "core/block.h"

namespace clsurf {

class BlockFill {
public:
    /// fill(first, last): fills points [first, last), a block of [0, count).
    using Fill = std::function<void(PointIndex first, PointIndex last)>;
    /// Blocks of `block` points, a power of two.
    BlockFill(PointIndex count, Fill fill, PointIndex block = block_points);

    /// Returns when the block of that point is filled. O(1) from the second time on.
    void need(PointIndex point) { need(point, fill_); }
    /// The same, filled by a function of the one who reads, where it may have moved since.
    void need(PointIndex point, const Fill& fill) {
        const auto block = static_cast<std::size_t>(point >> shift_);
        if (!filled_[block].load(std::memory_order_acquire)) fill_block(block, fill);
    }
    /// The same for all points from `first` to `last`, inclusive.
    void need(PointIndex first, PointIndex last) {
        for (PointIndex block = first >> shift_; block <= last >> shift_; ++block) need(block << shift_);
    }

    /// Points of a block.
    [[nodiscard]] PointIndex block() const { return PointIndex{1} << shift_; }
    /// Points of blocks that were filled, each time that they were.
    [[nodiscard]] PointIndex filled() const { return points_.load(); }
    /// Nothing is filled from now on. Nobody may be reading.
    void forget();

private:
    void fill_block(std::size_t block, const Fill& fill);

    PointIndex count_;
    int shift_;  ///< 2^shift points are a block
    Fill fill_;
    std::vector<std::atomic<bool>> filled_;
    std::array<std::mutex, 64> mutexes_;
    std::atomic<PointIndex> points_{0};
};

/// Frees what was filled, once it is much: called where nobody reads. Returns whether it did. Nothing: what is filled stays.
using ForgetBlocks = std::function<bool()>;

/// The BlockFill of columns that were given one; those of an ordinary log have none, and are there as a whole. What
/// fills knows where the columns are, so that these may be moved, but not copied.
class BlockFillPointer {
public:
    BlockFillPointer() = default;
    BlockFillPointer(PointIndex count, BlockFill::Fill fill, PointIndex block = block_points)
        : fill_(std::make_unique<BlockFill>(count, std::move(fill), block)) {}
    /// Throws std::logic_error where there is a BlockFill.
    BlockFillPointer(const BlockFillPointer& other);
    BlockFillPointer(BlockFillPointer&&) noexcept = default;
    BlockFillPointer& operator=(BlockFillPointer other) noexcept {
        fill_ = std::move(other.fill_);
        return *this;
    }
    ~BlockFillPointer() = default;

    void need(PointIndex point) const {
        if (fill_) fill_->need(point);
    }
    void need(PointIndex first, PointIndex last) const {
        if (fill_) fill_->need(first, last);
    }
    explicit operator bool() const { return fill_ != nullptr; }
    [[nodiscard]] BlockFill* get() const { return fill_.get(); }
    [[nodiscard]] BlockFill* operator->() const { return fill_.get(); }

private:
    std::unique_ptr<BlockFill> fill_;
};

}  // namespace clsurf
