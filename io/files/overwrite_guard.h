#pragma once
// No output overwrites an input. Files are compared by device and inode, which also covers links, "./" and file systems
// that ignore case. Every reader uses map_file() and every writer AtomicFile, and both check here.
// Used inside io only, except guard_inputs() and guard_input().

#include <sys/stat.h>

#include <string>

namespace clsurf::io {

/// After this call a file is read or written, not both, and is not written twice at the same time; standard output
/// counts as written if it is a file. For programs; called once.
void guard_inputs();

/// Registers `path` as read, for readers that do not use map_file(). A missing file is not an error here.
/// Throws UsageError if it is being written.
void guard_input(const std::string& path);

/// The same for an open file.
void guard_input(const std::string& path, const struct stat& status);

/// Marks a file as being written, until release() or the end of the object. The file need not exist.
class OutputClaim {
public:
    /// Throws UsageError: the path is an input, or another output.
    explicit OutputClaim(const std::string& path);
    OutputClaim(const OutputClaim&) = delete;
    OutputClaim& operator=(const OutputClaim&) = delete;
    ~OutputClaim() { release(); }
    void release();

private:
    int number_ = 0;  ///< 0: not guarded
};

}  // namespace clsurf::io
