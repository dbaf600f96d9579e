#pragma once
// The common part of fuzz targets: each takes any bytes, reads them as the program does, reads all results,
// and may only end with an InputError.

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "io/files/compressed.h"
#include "io/formats/log_format.h"
#include "log/health.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace clsurf::fuzz {

/// A file in memory, for readers that take a path.
class MemoryFile {
public:
    explicit MemoryFile(std::string_view bytes) : descriptor_(::memfd_create("fuzz", 0)) {
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written <= 0) break;
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() { ::close(descriptor_); }
    [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

private:
    int descriptor_;
};

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

inline io::Source source_of(std::string_view bytes) {
    return {"input", {reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()}, nullptr};
}

/// The input in two parts: before and after the first NUL byte.
inline std::pair<std::string_view, std::string_view> in_two(std::string_view input) {
    const std::size_t nul = std::min(input.find('\0'), input.size());
    return {input.substr(0, nul), input.substr(std::min(nul + 1, input.size()))};
}

/// Reads every value of every channel, and the output of info for the log.
inline void look_at(const Log& log) {
    std::array<double, 1024> values;
    for (const Channel& channel : log.channels) {
        for (PointIndex begin = 0; begin < log.records; begin += static_cast<PointIndex>(values.size())) {
            const auto n = static_cast<std::size_t>(
                std::min<PointIndex>(static_cast<PointIndex>(values.size()), log.records - begin));
            copy_block(channel.values, begin, {values.data(), n});
        }
    }
    for (const Diagnostic& d : log.diagnostics.summary()) (void)to_text(d);
    for (const Diagnostic& d : check_health(log, 100).summary()) (void)to_text(d);
}

/// Runs `read`; an InputError is a valid answer.
template <typename Read>
int answer(const Read& read) {
    try {
        read();
    } catch (const InputError& error) { (void)to_text(error.diagnostic()); }
    return 0;
}

}  // namespace clsurf::fuzz
