// A layout file, a NUL byte, and the records that it describes.
#include "fuzz/fuzz_input.h"

using namespace clsurf;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::answer([&] {
        const auto [layout, records] = fuzz::in_two(fuzz::text_of(data, size));
        const fuzz::MemoryFile file(layout);
        io::LogOptions options;
        options.layout = file.path();
        fuzz::look_at(io::open_log(fuzz::source_of(records), options));
    });
}
