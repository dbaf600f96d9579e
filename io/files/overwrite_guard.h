#pragma once
// Nothing overwrites an input: files are compared by device and inode, so that links, "./" and file systems
// that do not tell upper from lower case are seen through. Every reader comes through map_file() and every
// writer through AtomicFile, which ask here. Used inside io only, but for guard_inputs() and guard_input().

#include <sys/stat.h>

#include <string>

namespace clsurf::io {

/// From now on a file is read or written, not both, and is not written twice at the same time; standard output
/// counts as written where it is a file. For programs; called once.
void guard_inputs();

/// For readers that do not come through map_file(): `path` is read. A missing file is not an error here.
/// Throws UsageError where it is being written.
void guard_input(const std::string& path);

/// The same for a file that is open.
void guard_input(const std::string& path, const struct stat& status);

/// A file that is being written, from now until release() or the end of the object. A file need not exist.
class OutputClaim {
public:
    /// Throws UsageError: an input is there, or another output.
    explicit OutputClaim(const std::string& path);
    OutputClaim(const OutputClaim&) = delete;
    OutputClaim& operator=(const OutputClaim&) = delete;
    ~OutputClaim() { release(); }
    void release();

private:
    int number_ = 0;  ///< 0: not guarded
};

}  // namespace clsurf::io
