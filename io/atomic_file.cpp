#include "io/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <random>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "io/mapped_file.h"

namespace clsurf::io {
namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 20;

[[noreturn]] void fail(const std::string& path, const std::string& what) {
    throw SystemError(path + ": " + what + ": " + std::strerror(errno));
}

std::string folder_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? std::string(".") : path.substr(0, slash + 1);
}

}  // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)) {
    struct stat status {};
    if (::stat(path_.c_str(), &status) == 0) {
        if (S_ISDIR(status.st_mode)) {
            errno = EISDIR;
            fail(path_, "cannot write");
        }
        // A rename would put a file in the place of a device or a pipe.
        if (!S_ISREG(status.st_mode)) throw SystemError(path_ + ": cannot write: not a regular file");
        // What a link points at is replaced, not the link.
        char* target = ::realpath(path_.c_str(), nullptr);
        if (target != nullptr) path_ = target;
        std::free(target);
    }
    descriptor_ = ::open(folder_of(path_).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor_ >= 0) {
        temporary_ = fmt::format("/proc/self/fd/{}", descriptor_);
        if (::access(temporary_.c_str(), F_OK) == 0) return;
        ::close(descriptor_);  // without /proc it could never get its name
    } else if (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL && errno != ENOENT) {
        fail(path_, "cannot write");
    }
    std::string pattern = path_ + ".XXXXXX";
    descriptor_ = ::mkstemp(pattern.data());
    if (descriptor_ < 0) fail(path_, "cannot write");
    temporary_ = pattern;
    named_ = true;
    // mkstemp makes it private; an output has the rights that any new file would have.
    const mode_t mask = ::umask(0);
    ::umask(mask);
    ::fchmod(descriptor_, 0666 & ~mask);
}

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (named_) ::unlink(temporary_.c_str());
}

/// Links cannot replace a file, so it gets a name beside its target first.
void AtomicFile::give_a_name() {
    if (named_) return;
    std::random_device random;
    for (int attempt = 0; attempt < 100; ++attempt) {
        const std::string name = fmt::format("{}.{:06x}", path_, random() & 0xffffffU);
        if (::linkat(AT_FDCWD, temporary_.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) {
            temporary_ = name;
            named_ = true;
            return;
        }
        if (errno != EEXIST) break;
    }
    fail(path_, "cannot write");
}

void AtomicFile::flush() {
    std::size_t done = 0;
    while (done < buffer_.size()) {
        const ssize_t wrote = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
        if (wrote < 0 && errno == EINTR) continue;
        if (wrote < 0) fail(path_, "cannot write");
        done += static_cast<std::size_t>(wrote);
    }
    buffer_.clear();
}

void AtomicFile::write(std::span<const std::byte> bytes) {
    if (buffer_.size() + bytes.size() > buffer_bytes) flush();
    buffer_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

void AtomicFile::write_at(std::size_t offset, std::span<const std::byte> bytes) {
    flush();
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t wrote =
            ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
        if (wrote < 0 && errno == EINTR) continue;
        if (wrote < 0) fail(path_, "cannot write");
        done += static_cast<std::size_t>(wrote);
    }
}

void AtomicFile::commit() {
    flush();
    check_mapped_files();
    if (::fsync(descriptor_) != 0) fail(path_, "cannot write");
    give_a_name();
    if (::close(std::exchange(descriptor_, -1)) != 0) fail(path_, "cannot write");
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, "cannot rename into place");
    named_ = false;
    // The name itself must survive a power cut too; a folder that cannot be synchronised is no error.
    const int folder = ::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) {
        ::fsync(folder);
        ::close(folder);
    }
}

}  // namespace clsurf::io
