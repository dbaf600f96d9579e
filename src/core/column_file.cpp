#include "core/column_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "core/error.h"

namespace clsurf {
namespace {

struct ColumnFolder {
    std::string path;
    std::size_t least = 0;
};
ColumnFolder& column_folder() {
    static ColumnFolder folder;
    return folder;
}

[[noreturn]] void fail(int error) {
    throw SystemError("cannot keep columns in " + column_folder().path + ": " + std::strerror(error));
}

int open_nameless(const std::string& folder) {
    const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (descriptor >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL)) return descriptor;
    // For file systems without unnamed files.
    std::string name = folder + "/clsurf.XXXXXX";
    const int named = ::mkostemp(name.data(), O_CLOEXEC);
    if (named >= 0) ::unlink(name.c_str());
    return named;
}

/// Allocates the disk space now: a write to a mapping of a full disk would end the program.
int take_room(int descriptor, std::size_t bytes) { return ::posix_fallocate(descriptor, 0, static_cast<off_t>(bytes)); }

}  // namespace

void keep_columns_in(const std::string& folder, std::size_t least) {
    column_folder() = {folder, least};
    if (folder.empty()) return;
    const int descriptor = open_nameless(folder);
    if (descriptor < 0) {
        const int error = errno;
        column_folder() = {};
        throw SystemError("cannot keep columns in " + folder + ": " + std::strerror(error));
    }
    ::close(descriptor);
}

namespace column_file {

bool is_wanted(std::size_t bytes) { return !column_folder().path.empty() && bytes >= column_folder().least; }

Mapping make(std::size_t bytes) {
    Mapping mapping;
    mapping.descriptor = open_nameless(column_folder().path);
    if (mapping.descriptor < 0) fail(errno);
    int error = take_room(mapping.descriptor, bytes);
    if (error == 0) {
        mapping.data = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, mapping.descriptor, 0);
        if (mapping.data != MAP_FAILED) return mapping;
        error = errno;
    }
    ::close(mapping.descriptor);
    fail(error);
}

void grow(Mapping& mapping, std::size_t before, std::size_t bytes) {
    if (const int error = take_room(mapping.descriptor, bytes); error != 0) fail(error);
    void* const data = ::mremap(mapping.data, before, bytes, MREMAP_MAYMOVE);
    if (data == MAP_FAILED) fail(errno);
    mapping.data = data;
}

void remove(const Mapping& mapping, std::size_t bytes) noexcept {
    ::munmap(mapping.data, bytes);
    ::close(mapping.descriptor);
}

}  // namespace column_file
}  // namespace clsurf
