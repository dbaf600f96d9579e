#pragma once
// AtomicFile: an output that appears whole or not at all. Written beside its target, synchronised,
// renamed by commit(); removed when it is destroyed before that.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace clsurf::io {

class AtomicFile {
public:
    /// Opens a file beside `path`. Throws SystemError (no such folder, not writable).
    explicit AtomicFile(std::string path);
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    /// Throws SystemError (disk full).
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text.data(), text.size()))); }
    /// Overwrites bytes at `offset` that were written before (for headers).
    void write_at(std::size_t offset, std::span<const std::byte> bytes);
    /// Where to write for libraries that want a path: an existing file in the target's folder.
    [[nodiscard]] const std::string& temporary_path() const { return temporary_; }
    /// Flushes, synchronises and renames. Throws SystemError.
    void commit();

private:
    void flush();

    std::string path_;
    std::string temporary_;
    std::string buffer_;
    int descriptor_ = -1;
    bool committed_ = false;
};

}  // namespace clsurf::io
