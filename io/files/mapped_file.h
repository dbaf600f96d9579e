#pragma once
// The bytes of a file, read-only, mapped into memory. Standard input ("-"), pipes and
// other things that cannot be mapped are read into memory instead.

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace clsurf::io {

/// Bytes and who keeps them alive. A value: copies share the bytes.
struct Source {
    std::string name;  ///< as the user named it; "<stdin>" for "-"
    std::span<const std::byte> bytes;
    std::shared_ptr<const void> keep_alive;

    [[nodiscard]] std::string_view text() const { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
};

/// Maps a file. Throws InputError (missing, a directory, not readable).
[[nodiscard]] Source map_file(const std::string& path);

/// Maps a regular file that is open, as long as it is now. Throws InputError.
[[nodiscard]] Source map_descriptor(const std::string& name, int descriptor);

/// From now on a file that is cut short while it is mapped ends the program with a message and exit code
/// 3, where reading behind its end would have killed it; and check_mapped_files() knows the files of the whole run, because
/// the program's outputs were made from them. For programs; called once.
void guard_mapped_files();

/// Throws InputError where a file that is mapped became shorter, or with guard_mapped_files() one that was mapped: what was
/// read of it may be zeros. O(mapped files).
void check_mapped_files();

}  // namespace clsurf::io
