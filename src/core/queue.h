#pragma once
// Queue: first in, first out, with contiguous items, so that access to neighbouring items costs no more than in a
// vector.

#include <cstddef>
#include <span>
#include <vector>

namespace clsurf {

/// Each item is moved once on average. Adding an item may move the others.
template <typename T>
class Queue {
public:
    [[nodiscard]] bool empty() const { return first_ == items_.size(); }
    [[nodiscard]] std::size_t size() const { return items_.size() - first_; }
    [[nodiscard]] T& operator[](std::size_t i) { return items_[first_ + i]; }
    [[nodiscard]] const T& operator[](std::size_t i) const { return items_[first_ + i]; }
    [[nodiscard]] T& front() { return items_[first_]; }
    [[nodiscard]] const T& front() const { return items_[first_]; }
    [[nodiscard]] T& back() { return items_.back(); }
    [[nodiscard]] const T& back() const { return items_.back(); }
    /// Valid until an item is added.
    [[nodiscard]] std::span<const T> items() const { return std::span(items_).subspan(first_); }

    T& emplace_back() {
        make_room();
        return items_.emplace_back();
    }
    /// `item` must not be in this queue: its place may move.
    void push_back(const T& item) {
        make_room();
        items_.push_back(item);
    }
    void pop_front() {
        if (++first_ == items_.size()) clear();
    }
    void pop_back() { items_.pop_back(); }
    void clear() {
        items_.clear();
        first_ = 0;
    }

private:
    /// If half of the memory is before the first item, moves the items there instead of allocating more.
    void make_room() {
        if (items_.size() < items_.capacity() || first_ < size()) return;
        items_.erase(items_.begin(), items_.begin() + static_cast<std::ptrdiff_t>(first_));
        first_ = 0;
    }

    std::vector<T> items_;
    std::size_t first_ = 0;
};

}  // namespace clsurf
