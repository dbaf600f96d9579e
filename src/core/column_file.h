#pragma once
// Columns in files: large columns of a log that does not fit into memory are kept in files without a name, which are
// mapped. The system then writes to disk what is not looked at, and reads it again when it is.

#include <cstddef>
#include <string>

namespace clsurf {

/// From now on columns that grow to `least` bytes or more are kept in files in this folder; empty: all are in memory, as
/// they are at the beginning. Nobody may be making columns meanwhile. Throws SystemError: files cannot be made there.
void keep_columns_in(const std::string& folder, std::size_t least = std::size_t{64} << 20U);

namespace column_file {

/// A mapped file without a name.
struct Mapping {
    void* data = nullptr;
    int descriptor = -1;
};
/// Whether a column of so many bytes is to be in a file.
[[nodiscard]] bool is_wanted(std::size_t bytes);
/// Throws SystemError: the disk is full.
[[nodiscard]] Mapping make(std::size_t bytes);
/// Grows the file, and maps it where there is room. Throws SystemError: the disk is full; then it is as before.
void grow(Mapping& mapping, std::size_t before, std::size_t bytes);
void remove(const Mapping& mapping, std::size_t bytes) noexcept;

}  // namespace column_file
}  // namespace clsurf
