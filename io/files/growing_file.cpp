#include "io/files/growing_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>

#include <fmt/format.h>

#include "core/error.h"
#include "io/files/overwrite_guard.h"

namespace clsurf::io {
namespace {

constexpr double poll_interval = 0.02;  ///< [s] interval between checks of a file, which does not signal its growth

[[noreturn]] void fail_to_read(const std::string& name) {
    throw InputError(Place::of_file(name), std::string("cannot read: ") + std::strerror(errno));
}

/// A file without a name.
int open_copy() {
    std::string pattern = (std::filesystem::temp_directory_path() / "clsurf-follow-XXXXXX").string();
    const int copy = ::mkostemp(pattern.data(), O_CLOEXEC);
    if (copy < 0) throw SystemError(fmt::format("cannot write {}: {}", pattern, std::strerror(errno)));
    ::unlink(pattern.c_str());
    return copy;
}

}  // namespace

GrowingFile::GrowingFile(const std::string& path)
    : path_(path),
      name_(path == "-" ? "<stdin>" : path),
      descriptor_(path == "-" ? ::dup(STDIN_FILENO) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    if (descriptor_ < 0) throw InputError(Place::of_file(name_), std::string("cannot open: ") + std::strerror(errno));
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) fail_to_read(name_);
    if (S_ISDIR(status.st_mode)) throw InputError(Place::of_file(name_), "is a folder, expected a file");
    guard_input(name_, status);
    if (!S_ISREG(status.st_mode)) copy_ = open_copy();
}

GrowingFile::~GrowingFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (copy_ >= 0) ::close(copy_);
}

std::size_t GrowingFile::read(std::size_t most, std::vector<std::byte>& out) {
    return copy_ >= 0 ? read_stream(most, out) : read_file(most, out);
}

/// Checks whether the name still refers to the open file.
void GrowingFile::check_name() {
    if (path_ == "-") return;
    struct stat own {
    }, named{};
    if (::fstat(descriptor_, &own) != 0) fail_to_read(name_);
    if (::stat(path_.c_str(), &named) != 0) {
        ended_ = errno == ENOENT;  // removed, or renamed to its final name
        return;
    }
    if (own.st_dev != named.st_dev || own.st_ino != named.st_ino)
        throw InputError(Place::of_byte(name_, read_), "was replaced by another file while it was followed");
}

std::size_t GrowingFile::read_file(std::size_t most, std::vector<std::byte>& out) {
    check_name();  // first: bytes that were written before the name vanished are still read
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) fail_to_read(name_);
    const auto size = static_cast<std::size_t>(status.st_size);
    if (size < read_) {
        throw InputError(Place::of_byte(name_, size),
                         fmt::format("became shorter while it was followed: {} bytes, {} were read", size, read_));
    }
    const std::size_t wanted = std::min(most, size - read_), before = out.size();
    out.resize(before + wanted);
    std::size_t got = 0;
    while (got < wanted) {
        const ssize_t n =
            ::pread(descriptor_, out.data() + before + got, wanted - got, static_cast<off_t>(read_ + got));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail_to_read(name_);
        if (n == 0) break;
        got += static_cast<std::size_t>(n);
    }
    out.resize(before + got);
    read_ += got;
    return got;
}

std::size_t GrowingFile::read_stream(std::size_t most, std::vector<std::byte>& out) {
    std::array<std::byte, 65536> buffer;
    std::size_t got = 0;
    while (got < most && !ended_) {
        pollfd event{descriptor_, POLLIN, 0};
        // A pipe without a writer yet is neither readable nor hung up.
        if (::poll(&event, 1, 0) <= 0 || (event.revents & (POLLIN | POLLHUP | POLLERR)) == 0) break;
        const ssize_t n = ::read(descriptor_, buffer.data(), std::min(buffer.size(), most - got));
        if (n < 0 && (errno == EINTR || errno == EAGAIN)) break;
        if (n < 0) fail_to_read(name_);
        ended_ = n == 0;
        const auto size = static_cast<std::size_t>(n);
        keep(buffer.data(), size);
        out.insert(out.end(), buffer.begin(), buffer.begin() + n);
        got += size;
    }
    read_ += got;
    return got;
}

void GrowingFile::keep(const std::byte* bytes, std::size_t size) const {
    while (size > 0) {
        const ssize_t n = ::write(copy_, bytes, size);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0)
            throw SystemError(fmt::format("cannot keep a copy of {} in {}: {}", name_,
                                          std::filesystem::temp_directory_path().string(), std::strerror(errno)));
        bytes += n;
        size -= static_cast<std::size_t>(n);
    }
}

std::vector<std::byte> GrowingFile::read_again(std::size_t begin, std::size_t size) const {
    std::vector<std::byte> bytes(size);
    const ssize_t n = ::pread(copy_ >= 0 ? copy_ : descriptor_, bytes.data(), size, static_cast<off_t>(begin));
    bytes.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
    return bytes;
}

void GrowingFile::wait(double seconds) const {
    if (copy_ >= 0) {
        pollfd event{descriptor_, POLLIN, 0};
        (void)::poll(&event, 1, static_cast<int>(1e3 * seconds));
        if ((event.revents & POLLIN) != 0 || (event.revents & POLLHUP) == 0) return;
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(seconds, poll_interval)));
}

Source GrowingFile::whole() const { return map_descriptor(name_, copy_ >= 0 ? copy_ : descriptor_); }

}  // namespace clsurf::io
