#pragma once
// AtomicFile: an output that appears complete or not at all. It is written to a file without a name in the
// folder of the target, synchronised, and named by commit(). If the program ends before that, even by SIGKILL,
// no file remains. File systems without unnamed files (NFS, some overlays) get "NAME.XXXXXX" next to the target:
// it is removed if the object is destroyed before commit(), and remains if the program is killed.
//
// "-", /dev/stdout, /dev/fd/N, devices and pipes are written directly, all at once by commit().

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/files/overwrite_guard.h"

namespace clsurf::io {

/// Whether an output may replace an input, as in `compare --update`.
enum class Replaces { no_input, an_input };

/// What happens to an output that is not committed. An output that cannot be recomputed is kept: it is written to NAME.part,
/// which commit() renames.
enum class Unfinished { vanishes, stays };

class AtomicFile {
public:
    /// Opens a file in the folder of `path`. Throws SystemError (no such folder, not writable), UsageError if `path` is
    /// an input (io/files/overwrite_guard.h), or if an unfinished output of that name exists.
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
    /// Passes the written bytes to the system, so that they survive the end of the program. Throws SystemError.
    void save() { flush(); }
    /// The path for libraries that need one: an empty file that exists.
    [[nodiscard]] const std::string& temporary_path() const { return temporary_; }
    /// Flushes, synchronises and renames. Throws SystemError; InputError if an input became shorter
    /// while it was read (check_mapped_files()).
    void commit();

private:
    void open_in_folder();
    void open_part();
    void open_for_stream();
    void flush();
    void link_next_to_target();
    void copy_to_stream();

    std::string path_;
    std::optional<OutputClaim> claim_;
    int stream_ = -1;        ///< a device, a pipe or standard output; −1: a file
    std::string temporary_;  ///< a path of the file
    bool named_ = false;     ///< temporary_ is a name in the folder
    bool stays_ = false;     ///< the file is kept even without commit()
    std::string buffer_;
    int descriptor_ = -1;
};

}  // namespace clsurf::io
