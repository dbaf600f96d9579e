#pragma once
// GrowingFile: the bytes of a file, a pipe or standard input that another program is still writing.

#include <sys/types.h>

#include <cstddef>
#include <string>
#include <vector>

#include "io/files/mapped_file.h"

namespace clsurf::io {

class GrowingFile {
public:
    /// "-" is standard input. A named pipe need not have a writer yet. The bytes of a stream are copied to a file without a
    /// name in the folder for temporary files, so that whole() can read them again. Throws InputError (missing, a folder, not
    /// readable), SystemError (the copy cannot be made).
    explicit GrowingFile(const std::string& path);
    GrowingFile(const GrowingFile&) = delete;
    GrowingFile& operator=(const GrowingFile&) = delete;
    ~GrowingFile();

    [[nodiscard]] const std::string& name() const { return name_; }
    /// Appends at most `most` new bytes to `out`. Returns their number; 0: none yet. Throws InputError: the file became
    /// shorter than the part already read, or its name now refers to another file; SystemError: the copy of a stream cannot be
    /// written.
    std::size_t read(std::size_t most, std::vector<std::byte>& out);
    /// Bytes of a regular file that were read before, as they are now; fewer if the file ends earlier.
    [[nodiscard]] std::vector<std::byte> read_again(std::size_t begin, std::size_t size) const;
    /// No more bytes will come: the writer has closed the stream, or the file was removed or renamed.
    [[nodiscard]] bool ended() const { return ended_; }
    /// Waits until there may be more bytes, at most `seconds`, or until a signal arrives.
    void wait(double seconds) const;
    /// All bytes so far, mapped. Throws InputError.
    [[nodiscard]] Source whole() const;

private:
    void check_name();
    std::size_t read_file(std::size_t most, std::vector<std::byte>& out);
    std::size_t read_stream(std::size_t most, std::vector<std::byte>& out);
    void keep(const std::byte* bytes, std::size_t size) const;

    std::string path_, name_;
    int descriptor_ = -1;
    int copy_ = -1;  ///< descriptor of the copy of a stream; −1: a regular file
    std::size_t read_ = 0;
    bool ended_ = false;
};

}  // namespace clsurf::io
