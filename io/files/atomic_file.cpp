#include "io/files/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file_name.h"
#include "io/files/mapped_file.h"

namespace clsurf::io {
namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 20;

[[noreturn]] void fail(const std::string& path, const std::string& what) {
    throw SystemError(path + ": " + what + ": " + std::strerror(errno));
}

void write_all(int descriptor, std::string_view bytes, const std::string& path) {
    while (!bytes.empty()) {
        const ssize_t wrote = ::write(descriptor, bytes.data(), bytes.size());
        if (wrote < 0 && errno == EINTR) continue;
        if (wrote < 0) fail(path, "cannot write");
        bytes.remove_prefix(static_cast<std::size_t>(wrote));
    }
}

/// The descriptor that a name denotes: "-", "/dev/stdout", "/dev/fd/3". −1: a name in a folder.
int named_descriptor(std::string_view path) {
    if (path == "-" || path == "/dev/stdout") return STDOUT_FILENO;
    if (path == "/dev/stderr") return STDERR_FILENO;
    for (const std::string_view prefix : {"/dev/fd/", "/proc/self/fd/"}) {
        if (!path.starts_with(prefix)) continue;
        int number = -1;
        const char* const end = path.data() + path.size();
        const auto [at, error] = std::from_chars(path.data() + prefix.size(), end, number);
        if (error == std::errc() && at == end && number >= 0) return number;
    }
    return -1;
}

std::string path_of(int descriptor) { return fmt::format("/proc/self/fd/{}", descriptor); }

/// Opens the target of a stream; −1 if `path` is a file or does not exist yet.
int open_stream(const std::string& path) {
    const int named = named_descriptor(path);
    if (named == STDOUT_FILENO) std::fflush(stdout);  // earlier output comes first
    const int descriptor = named < 0 ? -1 : ::fcntl(named, F_DUPFD_CLOEXEC, 0);
    if (named >= 0 && descriptor < 0) fail(path, "cannot write");
    if (named >= 0) return descriptor;
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode)) return -1;
    // A rename would replace the device or the pipe by a file.
    const int opened = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (opened < 0) fail(path, "cannot write");
    return opened;
}

}  // namespace

AtomicFile::AtomicFile(std::string path, Replaces replaces, Unfinished unfinished)
    : path_(std::move(path)), stream_(open_stream(path_)) {
    if (stream_ >= 0) {
        open_for_stream();
        return;
    }
    if (replaces == Replaces::no_input) claim_.emplace(path_);
    // The target of a link is replaced, not the link.
    char* target = ::realpath(path_.c_str(), nullptr);
    if (target != nullptr) path_ = target;
    std::free(target);
    if (unfinished == Unfinished::stays)
        open_part();
    else
        open_in_folder();
}

void AtomicFile::open_part() {
    temporary_ = path_ + ".part";
    descriptor_ = ::open(temporary_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno == EEXIST) {
        throw UsageError(temporary_ + " exists: left by an interrupted run, or in use by another one",
                         "rename or remove it");
    }
    if (descriptor_ < 0) fail(temporary_, "cannot write");
    named_ = true;
    stays_ = true;
}

void AtomicFile::open_in_folder() {
    descriptor_ = ::open(folder_of(path_).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor_ >= 0) {
        temporary_ = path_of(descriptor_);
        if (::access(temporary_.c_str(), F_OK) == 0) return;
        ::close(descriptor_);  // without /proc the file could not be named later
    } else if (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL && errno != ENOENT) {
        fail(path_, "cannot write");
    }
    std::string pattern = path_ + ".XXXXXX";
    descriptor_ = ::mkstemp(pattern.data());
    if (descriptor_ < 0) fail(path_, "cannot write");
    temporary_ = pattern;
    named_ = true;
    // mkstemp makes the file private; an output gets the permissions of any new file.
    const mode_t mask = ::umask(0);
    ::umask(mask);
    ::fchmod(descriptor_, 0666 & ~mask);
}

/// A file without a name, because libraries seek in their output and a pipe cannot.
void AtomicFile::open_for_stream() {
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
    std::string pattern = (error ? std::filesystem::path("/tmp") : folder) / "clsurf.XXXXXX";
    descriptor_ = ::mkstemp(pattern.data());
    if (descriptor_ < 0) fail(pattern, "cannot write");
    ::unlink(pattern.c_str());
    temporary_ = path_of(descriptor_);
}

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (stream_ >= 0) ::close(stream_);
    if (named_ && !stays_) ::unlink(temporary_.c_str());
}

/// A link cannot replace a file, so the file first gets a name next to its target.
void AtomicFile::link_next_to_target() {
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
    write_all(descriptor_, buffer_, path_);
    buffer_.clear();
}

void AtomicFile::write(std::span<const std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (buffer_.size() + text.size() > buffer_bytes) flush();
    if (text.size() > buffer_bytes)
        write_all(descriptor_, text, path_);  // a column of gigabytes is not copied
    else
        buffer_.append(text);
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

void AtomicFile::copy_to_stream() {
    std::vector<char> bytes(buffer_bytes);
    for (off_t at = 0;;) {
        const ssize_t got = ::pread(descriptor_, bytes.data(), bytes.size(), at);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail(path_, "cannot read back");
        if (got == 0) break;
        at += got;
        write_all(stream_, {bytes.data(), static_cast<std::size_t>(got)}, path_);
    }
    if (::close(std::exchange(stream_, -1)) != 0) fail(path_, "cannot write");
}

void AtomicFile::commit() {
    flush();
    check_mapped_files();
    if (stream_ >= 0) {
        copy_to_stream();
        return;
    }
    if (::fsync(descriptor_) != 0) fail(path_, "cannot write");
    link_next_to_target();
    if (::close(std::exchange(descriptor_, -1)) != 0) fail(path_, "cannot write");
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, "cannot rename into place");
    named_ = false;
    if (claim_) claim_->release();
    // The name must survive a power failure as well. A folder that cannot be synchronised is not an error.
    const int folder = ::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) {
        ::fsync(folder);
        ::close(folder);
    }
}

}  // namespace clsurf::io
