#pragma once
// Column<T>: an owned, contiguous array of a trivially copyable type that grows without zeroing.
//
// Results of 10^7 … 10^8 points are kept in columns. std::vector would write every page twice (once
// to zero it, once with the value) and would copy on growth; realloc() lets the kernel move pages of
// large blocks instead, so that a column that grows never needs twice its memory.
//
// A sparse column takes memory only for the pages that are written. A borrowed one shows memory of another owner, for
// example a mapped file. Both serve logs that are read only in part (core/block_fill.h).
// Large columns may be kept in files (core/column_file.h).

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

#include "core/column_file.h"

namespace clsurf {

template <typename T>
class Column {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    Column() = default;
    /// A column of `size` elements whose values are not set.
    explicit Column(std::size_t size) { resize(size); }
    Column(std::size_t size, T value) {
        resize(size);
        for (std::size_t i = 0; i < size; ++i) data_[i] = value;
    }
    /// A column of `size` zeros that takes memory only for the pages that are written. It does not grow.
    [[nodiscard]] static Column sparse(std::size_t size) {
        Column column;
        if (size == 0) return column;
        if (size > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_alloc();
        void* const pages = ::mmap(nullptr, size * sizeof(T), PROT_READ | PROT_WRITE,
                                   MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
        if (pages == MAP_FAILED) throw std::bad_alloc();
        // A huge page would take memory for elements that are not written.
        ::madvise(pages, size * sizeof(T), MADV_NOHUGEPAGE);
        column.data_ = static_cast<T*>(pages);
        column.size_ = column.capacity_ = size;
        column.storage_ = Storage::sparse;
        return column;
    }
    /// A read-only column over these values, which must outlive it. It does not grow.
    [[nodiscard]] static Column borrowed(std::span<const T> values) {
        Column column;
        column.data_ = const_cast<T*>(values.data());
        column.size_ = column.capacity_ = values.size();
        column.storage_ = Storage::borrowed;
        return column;
    }
    Column(const Column& other) {
        resize(other.size_);
        if (size_ > 0) std::memcpy(static_cast<void*>(data_), other.data_, size_ * sizeof(T));
    }
    Column(Column&& other) noexcept
        : data_(std::exchange(other.data_, nullptr)),
          size_(std::exchange(other.size_, 0)),
          capacity_(std::exchange(other.capacity_, 0)),
          descriptor_(std::exchange(other.descriptor_, -1)),
          storage_(std::exchange(other.storage_, Storage::owned)) {}
    Column& operator=(Column other) noexcept {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        std::swap(capacity_, other.capacity_);
        std::swap(descriptor_, other.descriptor_);
        std::swap(storage_, other.storage_);
        return *this;
    }
    ~Column() {
        if (storage_ == Storage::owned) std::free(data_);
        if (storage_ == Storage::sparse) ::munmap(static_cast<void*>(data_), capacity_ * sizeof(T));
        if (storage_ == Storage::file) column_file::remove({data_, descriptor_}, capacity_ * sizeof(T));
    }

    /// Sparse columns only: sets all values to zero and frees their memory.
    void forget() noexcept {
        if (storage_ == Storage::sparse) ::madvise(static_cast<void*>(data_), capacity_ * sizeof(T), MADV_DONTNEED);
    }

    /// Grows or shrinks; new elements are not set.
    void resize(std::size_t size) {
        if (size > capacity_) reserve(size);
        size_ = size;
    }
    void reserve(std::size_t capacity) {
        if (capacity <= capacity_) return;
        if (capacity > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_alloc();
        if (storage_ == Storage::file || (storage_ == Storage::owned && column_file::is_wanted(capacity * sizeof(T)))) {
            grow_in_file(capacity);
            return;
        }
        if (storage_ != Storage::owned) throw std::bad_alloc();
        void* grown = std::realloc(static_cast<void*>(data_), capacity * sizeof(T));
        if (grown == nullptr) throw std::bad_alloc();
        data_ = static_cast<T*>(grown);
        capacity_ = capacity;
    }
    void push_back(const T& value) {
        if (size_ == capacity_) {
            const T copy = value;  // `value` may live in this column
            reserve(capacity_ < 16 ? 16 : capacity_ + capacity_ / 2);
            data_[size_++] = copy;
            return;
        }
        data_[size_++] = value;
    }
    /// Frees the memory beyond size().
    void shrink_to_fit() {
        if (size_ == capacity_ || storage_ != Storage::owned) return;
        if (size_ == 0) {
            std::free(std::exchange(data_, nullptr));
            capacity_ = 0;
            return;
        }
        if (void* shrunk = std::realloc(static_cast<void*>(data_), size_ * sizeof(T))) {
            data_ = static_cast<T*>(shrunk);
            capacity_ = size_;
        }
    }
    void clear() noexcept { size_ = 0; }
    /// Removes the first elements. O(remaining elements).
    void drop_front(std::size_t count) noexcept {
        size_ -= count;
        if (size_ > 0) std::memmove(static_cast<void*>(data_), data_ + count, size_ * sizeof(T));
    }

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }
    [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
    [[nodiscard]] T* data() noexcept { return data_; }
    [[nodiscard]] const T* data() const noexcept { return data_; }
    T& operator[](std::size_t i) noexcept { return data_[i]; }
    const T& operator[](std::size_t i) const noexcept { return data_[i]; }
    T& back() noexcept { return data_[size_ - 1]; }
    const T& back() const noexcept { return data_[size_ - 1]; }
    T* begin() noexcept { return data_; }
    T* end() noexcept { return data_ + size_; }
    const T* begin() const noexcept { return data_; }
    const T* end() const noexcept { return data_ + size_; }
    // NOLINTNEXTLINE(google-explicit-constructor): a column reads as a span wherever one is wanted
    operator std::span<const T>() const noexcept { return {data_, size_}; }
    // NOLINTNEXTLINE(google-explicit-constructor)
    operator std::span<T>() noexcept { return {data_, size_}; }

private:
    enum class Storage : unsigned char { owned, sparse, borrowed, file };

    void grow_in_file(std::size_t capacity) {
        if (storage_ == Storage::file) {
            column_file::Mapping mapping{data_, descriptor_};
            column_file::grow(mapping, capacity_ * sizeof(T), capacity * sizeof(T));
            data_ = static_cast<T*>(mapping.data);
        } else {
            const column_file::Mapping mapping = column_file::make(capacity * sizeof(T));
            if (size_ > 0) std::memcpy(mapping.data, static_cast<const void*>(data_), size_ * sizeof(T));
            std::free(data_);
            data_ = static_cast<T*>(mapping.data);
            descriptor_ = mapping.descriptor;
            storage_ = Storage::file;
        }
        capacity_ = capacity;
    }

    T* data_ = nullptr;
    std::size_t size_ = 0;
    std::size_t capacity_ = 0;
    int descriptor_ = -1;  ///< of a column in a file
    Storage storage_ = Storage::owned;
};

}  // namespace clsurf
