#pragma once
// The bytes of a file, read-only, mapped into memory. Standard input ("-"), pipes and
// other things that cannot be mapped are read into memory instead.

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace clsurf::io {

/// Bytes and the owner of their memory. A value: copies share the bytes.
struct Source {
    std::string name;  ///< as given by the user; "<stdin>" for "-"
    std::span<const std::byte> bytes;
    std::shared_ptr<const void> keep_alive;

    [[nodiscard]] std::string_view text() const { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
};

/// Maps a file. Throws InputError (missing, a directory, not readable).
[[nodiscard]] Source map_file(const std::string& path);

/// Maps an open regular file at its present length. Throws InputError.
[[nodiscard]] Source map_descriptor(const std::string& name, int descriptor);

/// After this call, a mapped file that is truncated ends the program with a message and exit code 3; without it, reading
/// beyond the end would kill the program. check_mapped_files() then covers the files of the whole run, because
/// the outputs were made from them. For programs; called once.
void guard_mapped_files();

/// Throws InputError if a mapped file became shorter; after guard_mapped_files(), also if a file that was mapped earlier did.
/// What was read from such a file may be zeros. O(mapped files).
void check_mapped_files();

}  // namespace clsurf::io
