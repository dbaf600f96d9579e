#include "io/files/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <mutex>
#include <vector>

#include "core/error.h"
#include "io/files/overwrite_guard.h"

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

/// A mapped file, in a form that a signal handler can read. All code but the handler acquires `mapping_lock`.
struct MappedRegion {
    std::atomic<const std::byte*> begin{nullptr};
    std::size_t size = 0;
    int descriptor = -1;
    std::array<char, 256> name{};  ///< as given by the user; the end of a longer name
    bool taken = false;
};

/// More files than any subcommand reads; further ones are not guarded.
std::array<MappedRegion, 64> mappings;
std::mutex mapping_lock;

MappedRegion* enter(const std::string& name, const void* address, std::size_t size, int descriptor) {
    const std::lock_guard lock(mapping_lock);
    for (MappedRegion& mapping : mappings) {
        if (mapping.taken) continue;
        mapping.taken = true;
        const std::size_t cut = name.size() < mapping.name.size() ? 0 : name.size() - mapping.name.size() + 1;
        std::strcpy(mapping.name.data(), name.c_str() + cut);
        mapping.size = size;
        mapping.descriptor = ::dup(descriptor);
        mapping.begin = static_cast<const std::byte*>(address);
        return &mapping;
    }
    return nullptr;
}

/// In a guarded program: a file that became shorter while it was mapped and is no longer mapped. In other programs,
/// finished calls must not make later ones fail.
std::array<char, 256> shortened{};
bool guards_mappings = false;

bool is_shorter(const MappedRegion& mapping) {
    struct stat status {};
    return mapping.descriptor >= 0 && ::fstat(mapping.descriptor, &status) == 0 &&
           static_cast<std::size_t>(status.st_size) < mapping.size;
}

void leave(MappedRegion* mapping) {
    if (mapping == nullptr) return;
    const std::lock_guard lock(mapping_lock);
    mapping->begin = nullptr;
    if (guards_mappings && is_shorter(*mapping)) shortened = mapping->name;
    if (mapping->descriptor >= 0) ::close(mapping->descriptor);
    mapping->taken = false;
}

constexpr const char* shorter = "became shorter while it was read";

/// Writes "FILE: error: became shorter …" in one call, so that messages of several threads do not mix.
void print_shorter(const char* name) {
    std::array<char, 512> text{};
    std::size_t length = 0;
    for (const char* part : {name, ": error: ", shorter, "\n"}) {
        const std::size_t size = std::min(std::strlen(part), text.size() - length);
        std::memcpy(text.data() + length, part, size);
        length += size;
    }
    // If the message cannot be written, nothing can be done.
    if (::write(STDERR_FILENO, text.data(), length) < 0) return;
}

/// One thread reports the error; the others wait for the end of the program.
std::atomic_flag reported = ATOMIC_FLAG_INIT;

/// Calls only functions that are safe in a signal handler.
void on_bus_error(int number, siginfo_t* info, void*) {
    const auto* address = static_cast<const std::byte*>(info->si_addr);
    for (const MappedRegion& mapping : mappings) {
        const std::byte* begin = mapping.begin;
        if (begin == nullptr || address < begin || address >= begin + mapping.size) continue;
        if (reported.test_and_set()) {
            while (true) ::pause();
        }
        print_shorter(mapping.name.data());
        ::_exit(static_cast<int>(ExitCode::bad_input));
    }
    ::signal(number, SIG_DFL);  // not a guarded file: the signal repeats and ends the program as usual
}

}  // namespace

void guard_mapped_files() {
    struct sigaction action {};
    action.sa_sigaction = on_bus_error;
    action.sa_flags = SA_SIGINFO;
    ::sigemptyset(&action.sa_mask);
    ::sigaction(SIGBUS, &action, nullptr);
    const std::lock_guard lock(mapping_lock);
    guards_mappings = true;
}

void check_mapped_files() {
    const std::lock_guard lock(mapping_lock);
    for (const MappedRegion& mapping : mappings) {
        if (mapping.begin != nullptr && is_shorter(mapping))
            throw InputError(Place::of_file(mapping.name.data()), shorter);
    }
    if (shortened[0] != '\0') throw InputError(Place::of_file(shortened.data()), shorter);
}

Source map_file(const std::string& path) {
    if (path == "-") {
        struct stat status {};
        if (::fstat(STDIN_FILENO, &status) == 0) guard_input("<stdin>", status);
        return read_stream("<stdin>", STDIN_FILENO);
    }
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.get() < 0) { throw InputError(Place::of_file(path), std::string("cannot open: ") + std::strerror(errno)); }
    struct stat status {};
    if (::fstat(file.get(), &status) != 0) {
        throw InputError(Place::of_file(path), std::string("cannot read: ") + std::strerror(errno));
    }
    if (S_ISDIR(status.st_mode)) throw InputError(Place::of_file(path), "is a folder, expected a file");
    if (!S_ISREG(status.st_mode)) return read_stream(path, file.get());
    guard_input(path, status);
    return map_descriptor(path, file.get());
}

Source map_descriptor(const std::string& name, int descriptor) {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) {
        throw InputError(Place::of_file(name), std::string("cannot read: ") + std::strerror(errno));
    }
    const auto size = static_cast<std::size_t>(status.st_size);
    if (size == 0) return {name, {}, nullptr};
    void* address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (address == MAP_FAILED) return read_stream(name, descriptor);
    MappedRegion* entry = enter(name, address, size, descriptor);
    const std::shared_ptr<const void> keep_alive(address, [size, entry](const void* mapped) {
        leave(entry);
        ::munmap(const_cast<void*>(mapped), size);
    });
    return {name, {static_cast<const std::byte*>(address), size}, keep_alive};
}

}  // namespace clsurf::io
