#include "core/block_fill.h"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

namespace clsurf {

BlockFill::BlockFill(PointIndex count, Fill fill, PointIndex block)
    : count_(count),
      shift_(std::countr_zero(static_cast<std::uint64_t>(block))),
      fill_(std::move(fill)),
      filled_(static_cast<std::size_t>((count + block - 1) / block)) {}

void BlockFill::fill_block(std::size_t block, const Fill& fill) {
    const std::scoped_lock lock(mutexes_[block % mutexes_.size()]);
    if (filled_[block].load(std::memory_order_relaxed)) return;
    const PointIndex first = static_cast<PointIndex>(block) << shift_;
    const PointIndex last = std::min(count_, first + (PointIndex{1} << shift_));
    fill(first, last);
    points_ += last - first;
    filled_[block].store(true, std::memory_order_release);
}

void BlockFill::forget() {
    for (std::atomic<bool>& filled : filled_) filled.store(false, std::memory_order_relaxed);
}

BlockFillPointer::BlockFillPointer(const BlockFillPointer& other) {
    if (other.fill_) throw std::logic_error("columns that are filled when they are read were copied");
}

}  // namespace clsurf
