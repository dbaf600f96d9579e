#include "io/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <vector>

#include "core/error.h"

namespace clsurf::io {
namespace {

class Descriptor {
public:
    explicit Descriptor(int value) : value_(value) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (value_ > STDERR_FILENO) ::close(value_);
    }
    [[nodiscard]] int get() const { return value_; }

private:
    int value_;
};

Source read_stream(const std::string& name, int descriptor) {
    auto bytes = std::make_shared<std::vector<std::byte>>();
    std::size_t size = 0;
    for (;;) {
        if (bytes->size() - size < (std::size_t{1} << 16)) bytes->resize(bytes->size() * 2 + (1u << 17));
        const ssize_t got = ::read(descriptor, bytes->data() + size, bytes->size() - size);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw InputError(Place::of_file(name), std::string("cannot read: ") + std::strerror(errno));
        if (got == 0) break;
        size += static_cast<std::size_t>(got);
    }
    bytes->resize(size);
    return {name, std::span<const std::byte>(*bytes), bytes};
}

}  // namespace

Source map_file(const std::string& path) {
    if (path == "-") return read_stream("<stdin>", STDIN_FILENO);
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.get() < 0) {
        throw InputError(Place::of_file(path), std::string("cannot open: ") + std::strerror(errno));
    }
    struct stat status {};
    if (::fstat(file.get(), &status) != 0) {
        throw InputError(Place::of_file(path), std::string("cannot read: ") + std::strerror(errno));
    }
    if (S_ISDIR(status.st_mode)) throw InputError(Place::of_file(path), "is a folder, expected a file");
    if (!S_ISREG(status.st_mode)) return read_stream(path, file.get());
    const auto size = static_cast<std::size_t>(status.st_size);
    if (size == 0) return {path, {}, nullptr};
    void* address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.get(), 0);
    if (address == MAP_FAILED) return read_stream(path, file.get());
    const std::shared_ptr<const void> keep_alive(
        address, [size](const void* mapped) { ::munmap(const_cast<void*>(mapped), size); });
    return {path, {static_cast<const std::byte*>(address), size}, keep_alive};
}

}  // namespace clsurf::io
