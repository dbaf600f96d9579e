#pragma once
// Columns in files: large columns of a log that does not fit in memory are kept in unnamed temporary files, which are mapped.
// The system writes unused pages to disk and reads them back when they are needed.

#include <cstddef>
#include <string>

namespace clsurf {

/// From now on, columns that grow to `least` bytes or more are kept in files in this folder; an empty folder name keeps all
/// in memory, which is the default. Not thread-safe: call it before columns are made. Throws SystemError if files cannot be
/// made there.
void keep_columns_in(const std::string& folder, std::size_t least = std::size_t{64} << 20U);

namespace column_file {

/// A mapped temporary file.
struct Mapping {
    void* data = nullptr;
    int descriptor = -1;
};
/// Whether a column of this many bytes belongs in a file.
[[nodiscard]] bool is_wanted(std::size_t bytes);
/// Throws SystemError if the disk is full.
[[nodiscard]] Mapping make(std::size_t bytes);
/// Grows the file; the mapping may move. Throws SystemError if the disk is full; the mapping is then unchanged.
void grow(Mapping& mapping, std::size_t before, std::size_t bytes);
void remove(const Mapping& mapping, std::size_t bytes) noexcept;

}  // namespace column_file
}  // namespace clsurf
