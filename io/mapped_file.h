#pragma once
// MappedFile: the bytes of a file, read-only, mapped into memory. Standard input ("-"), pipes and
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

    [[nodiscard]] std::string_view text() const {
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
};

/// Maps a file. Throws InputError (missing, a directory, not readable).
[[nodiscard]] Source map_file(const std::string& path);

}  // namespace clsurf::io
