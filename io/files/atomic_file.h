#pragma once
// AtomicFile: an output that appears whole or not at all. Written to a file without a name in its
// target's folder, synchronised, and given the name by commit(): whatever ends the program before that,
// be it SIGKILL, leaves nothing behind. File systems that have no nameless files (NFS, some overlays)
// get "NAME.XXXXXX" beside the target, which is removed when it is destroyed before commit(), and stays
// when the program is killed.
//
// "-", /dev/stdout, /dev/fd/N, devices and pipes are written to as they are, all at once by commit().

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/files/overwrite_guard.h"

namespace clsurf::io {

/// Whether an output may replace an input, as `compare --update` does.
enum class Replaces { no_input, an_input };

/// What becomes of an output that is not committed. What cannot be made again stays: it is written to NAME.part, which
/// commit() renames.
enum class Unfinished { vanishes, stays };

class AtomicFile {
public:
    /// Opens a file beside `path`. Throws SystemError (no such folder, not writable), UsageError where `path` is
    /// an input (io/files/overwrite_guard.h), or where an unfinished output of that name has stayed.
    explicit AtomicFile(std::string path, Replaces replaces = Replaces::no_input,
                        Unfinished unfinished = Unfinished::vanishes);
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    /// Throws SystemError (disk full).
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text.data(), text.size()))); }
    /// Overwrites bytes at `offset` that were written before (for headers).
    void write_at(std::size_t offset, std::span<const std::byte> bytes);
    /// Hands what was written to the system: then it survives the end of the program. Throws SystemError.
    void save() { flush(); }
    /// Where to write for libraries that want a path: a file that is there and empty.
    [[nodiscard]] const std::string& temporary_path() const { return temporary_; }
    /// Flushes, synchronises and renames. Throws SystemError; InputError where an input became shorter
    /// while it was read (check_mapped_files()).
    void commit();

private:
    void open_beside();
    void open_part();
    void open_for_stream();
    void flush();
    void give_a_name();
    void copy_to_stream();

    std::string path_;
    std::optional<OutputClaim> claim_;
    int stream_ = -1;        ///< of a device, a pipe or standard output; −1: a file
    std::string temporary_;  ///< a path of the file
    bool named_ = false;     ///< that path is a name in the folder
    bool stays_ = false;     ///< without commit(), too
    std::string buffer_;
    int descriptor_ = -1;
};

}  // namespace clsurf::io
