#pragma once
// AtomicFile: an output that appears whole or not at all. Written to a file without a name in its
// target's folder, synchronised, and given the name by commit(): whatever ends the program before that,
// be it SIGKILL, leaves nothing behind. File systems that have no nameless files (NFS, some overlays)
// get "NAME.XXXXXX" beside the target, which is removed when it is destroyed before commit(), and stays
// when the program is killed.

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
    /// Where to write for libraries that want a path: a file that is there and empty.
    [[nodiscard]] const std::string& temporary_path() const { return temporary_; }
    /// Flushes, synchronises and renames. Throws SystemError; InputError where an input became shorter
    /// while it was read (check_mapped_files()).
    void commit();

private:
    void flush();
    void give_a_name();

    std::string path_;
    std::string temporary_;  ///< a path of the file
    bool named_ = false;     ///< that path is a name in the folder
    std::string buffer_;
    int descriptor_ = -1;
};

}  // namespace clsurf::io
