#pragma once
// BlockFill: columns whose blocks are filled when they are first read. If a log is too large for memory, only the points
// that are read are computed: the points of a shard and of the adjacent passes with which it is compared.
//
// Any number of threads may read. A fill function must not read a block of its own columns, but it may read columns that
// are filled by another BlockFill, and so on. Thus a block waits only for other columns, and never in a cycle. A fill
// function must not work in parallel: a thread that waits for its helpers would take up other work, which may wait for
// this block.

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
    /// The same with a fill function given by the caller, because captured objects may have moved since construction.
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
    /// Number of points in filled blocks, counted each time that a block is filled.
    [[nodiscard]] PointIndex filled() const { return points_.load(); }
    /// Marks all blocks as not filled. No thread may be reading.
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

/// Frees filled blocks if they take much memory; called when nobody reads. Returns whether it did. An empty function: filled
/// blocks are kept.
using ForgetBlocks = std::function<bool()>;

/// The BlockFill of columns, if they have one; the columns of an ordinary log have none and are complete. The fill
/// function refers to the columns, so an object with a BlockFill can be moved but not copied.
class BlockFillPointer {
public:
    BlockFillPointer() = default;
    BlockFillPointer(PointIndex count, BlockFill::Fill fill, PointIndex block = block_points)
        : fill_(std::make_unique<BlockFill>(count, std::move(fill), block)) {}
    /// Throws std::logic_error if `other` has a BlockFill.
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
